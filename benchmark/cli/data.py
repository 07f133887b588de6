"""``mocapbench data``: which recordings are here, getting those that are not, checking them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

from mocapbench.benchmark.errors import ExitCode, UsageError
from mocapbench.benchmark.registry import TASKS
from mocapbench.datasets import (
    Archive,
    DigestMismatch,
    FetchError,
    RecordingStatus,
    ServerUnreachable,
    open_archive,
)

__all__ = ["DataDir", "app", "archive_at", "fetch_missing"]

app = typer.Typer(help="Look for, fetch and verify recordings.", no_args_is_help=True)

DataDir = Annotated[
    Path | None,
    typer.Option(envvar="MOCAPBENCH_DATA", help="A folder of recordings (subjects/NN/…)."),
]
Trials = Annotated[
    list[str] | None, typer.Argument(help="Such as 35_02; all that the tasks use if none.")
]


def archive_at(data_dir: Path | None) -> Archive:
    """Return the archive over ``data_dir``, the cache and the synthetic gait.

    Raises
    ------
    UsageError
        If ``data_dir`` is not a folder.
    """
    if data_dir is not None and not data_dir.is_dir():
        raise UsageError(
            f"--data-dir: expected a folder that holds subjects/NN/NN.asf, got {str(data_dir)!r}; "
            "name one, or leave the option out to download"
        )
    return open_archive(data_dir)


def fetch_missing(archive: Archive, uris: Sequence[str], console: Console) -> None:
    """Download what is not here; what cannot be had is said once and left missing.

    A recording whose digest is wrong is an error; a server that does not answer, or does not have
    a recording, is not.
    """
    missing = [uri for uri in uris if not archive.available(uri)]
    for uri in _tracked(missing, console):
        try:
            archive.fetch([uri])
        except (ServerUnreachable, OSError) as error:
            console.print(f"working without {len(missing)} recordings: {error}", markup=False)
            return
        except FetchError as error:
            console.print(f"working without {uri}: {error}", markup=False)


def _tracked(uris: Sequence[str], console: Console) -> Iterable[str]:
    return track(uris, "fetching recordings", console=console, disable=not uris, transient=True)


@app.command()
def status(trials: Trials = None, data_dir: DataDir = None) -> None:
    """Show which recordings are on this machine, without reading them."""
    archive = archive_at(data_dir)
    _show(archive.status(_addresses(trials)))


@app.command()
def fetch(trials: Trials = None, data_dir: DataDir = None) -> None:
    """Download recordings; those that are here and right are left alone."""
    archive, console, addresses = archive_at(data_dir), Console(), _addresses(trials)
    failures = []
    for uri in _tracked(addresses, console):
        try:
            archive.fetch([uri])
        except ServerUnreachable as error:
            raise UsageError(str(error)) from error
        except (FetchError, DigestMismatch) as error:
            failures.append(str(error))
    _show(archive.status(addresses))
    if failures:
        raise UsageError("\n".join(failures))


@app.command()
def verify(trials: Trials = None, data_dir: DataDir = None) -> None:
    """Read the recordings that are here and check their digests."""
    archive = archive_at(data_dir)
    rows = [row for uri in track(_addresses(trials), "verifying") for row in archive.verify([uri])]
    _show(rows)
    if any(row.state == "wrong" for row in rows):
        raise typer.Exit(ExitCode.USAGE)


def _addresses(trials: Iterable[str] | None) -> list[str]:
    """Return the addresses of ``trials``, or of every recording that a task uses."""
    if trials:
        addresses = [trial if ":" in trial else f"cmu:{trial}" for trial in trials]
        try:
            open_archive().status(addresses)
        except ValueError as error:
            raise UsageError(str(error)) from error
        return addresses
    cases = (case for name in TASKS.names() for case in TASKS.get(name).cases)
    sources = {uri for case in cases for uri in case.needs if uri.startswith("cmu:")}
    return sorted(sources)


def _show(rows: Sequence[RecordingStatus]) -> None:
    table = Table("recording", "state", "where", "SHA-256")
    for row in rows:
        table.add_row(row.uri, row.state, row.where, row.digest[:16])
    Console().print(table)
