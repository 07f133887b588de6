"""``mocapbench data``: which recordings are here, getting those that are not, checking them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.progress import track
from rich.table import Column, Table

from mocapbench import benchmark as bench
from mocapbench import datasets
from mocapbench.basics.path_lists import named_folders
from mocapbench.basics.words import format_count
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import DataDir, Plugins, load_plugins, open_archive
from mocapbench.benchmark.errors import ExitCode, UsageError

if TYPE_CHECKING:
    from mocapbench.datasets import Archive, RecordingStatus

__all__ = ["app", "fetch_missing"]

app: typer.Typer = typer.Typer(
    help="Look for, fetch and verify recordings.", no_args_is_help=True, add_completion=False
)

Trials = Annotated[
    list[str] | None,
    typer.Argument(help="Such as 35_02, or a library; all that the tasks use if none."),
]

NamedTrials = Annotated[list[str], typer.Argument(help="Such as 35_02.")]


def fetch_missing(archive: Archive, uris: Sequence[str], console: LiteralConsole) -> None:
    """Download what is not here; what cannot be had is said once and left missing.

    A recording whose digest is wrong is an error; a server that does not answer, or does not have
    a recording, is not.
    """
    missing = [uri for uri in uris if not archive.available(uri)]
    for line in bench.advise_supply(missing, archive):
        console.print(f"working without what is not here: {line}", soft_wrap=True)
    missing = [uri for uri in missing if not archive.advice(uri)]
    for uri in _track_fetching(missing, console):
        try:
            archive.fetch([uri])
        except (datasets.ServerUnreachable, OSError) as error:
            console.print(f"working without {format_count(len(missing), 'recording')}: {error}")
            return
        except datasets.FetchError as error:
            console.print(f"working without {uri}: {error}")


def _track_fetching(uris: Sequence[str], console: LiteralConsole) -> Iterable[str]:
    return track(uris, "fetching recordings", console=console, disable=not uris, transient=True)


@app.command()
def status(trials: Trials = None, data_dir: DataDir = None, plugin: Plugins = None) -> None:
    """Show which recordings are on this machine, without reading them."""
    load_plugins(plugin)
    archive, console = open_archive(data_dir), LiteralConsole()
    rows = archive.status(_addresses(trials, archive))
    _show(rows, data_dir, console)
    _suggest(rows, trials, data_dir, plugin, archive)


@app.command()
def fetch(trials: Trials = None, data_dir: DataDir = None, plugin: Plugins = None) -> None:
    """Download recordings; those that are here and right are left alone."""
    load_plugins(plugin)
    archive = open_archive(data_dir)
    rows = _get_each(archive, lambda uri: archive.fetch([uri]), trials, data_dir)
    _suggest(rows, trials, data_dir, plugin, archive)


@app.command()
def renew(trials: NamedTrials, data_dir: DataDir = None, plugin: Plugins = None) -> None:
    """Take the copies that are here as right from now on, or those of the server.

    Of a recording that no registry lists, the first copy is recorded as right. This forgets it.
    """
    load_plugins(plugin)
    archive = open_archive(data_dir)
    rows = _get_each(archive, archive.renew, trials, data_dir)
    _suggest(rows, trials, data_dir, plugin, archive)


@app.command()
def verify(trials: Trials = None, data_dir: DataDir = None, plugin: Plugins = None) -> None:
    """Read the recordings that are here and check their digests."""
    load_plugins(plugin)
    archive, console = open_archive(data_dir), LiteralConsole()
    tracked = track(_addresses(trials, archive), "verifying", console=console)
    rows = [row for uri in tracked for row in archive.verify([uri])]
    _show(rows, data_dir, console)
    _suggest(rows, trials, data_dir, plugin, archive)
    if any(row.state == "wrong" for row in rows):
        raise typer.Exit(ExitCode.USAGE)


def _get_each(
    archive: Archive,
    get: Callable[[str], object],
    trials: Sequence[str] | None,
    data_dir: str | None,
) -> Sequence[RecordingStatus]:
    """Get all recordings that can be had, show what is here, and say what failed."""
    console, addresses = LiteralConsole(), _addresses(trials, archive)
    missing = [uri for uri in addresses if not archive.available(uri)]
    failures = bench.advise_supply(missing, archive)
    for uri in _track_fetching(addresses, console):
        if uri in missing and archive.advice(uri):
            continue
        try:
            get(uri)
        except datasets.ServerUnreachable as error:
            raise UsageError(str(error)) from error
        except (datasets.FetchError, datasets.DigestMismatch) as error:
            failures.append(str(error))
    rows = archive.status(addresses)
    _show(rows, data_dir, console)
    if failures:
        raise UsageError("\n".join(failures))
    return rows


def _addresses(trials: Iterable[str] | None, archive: Archive) -> list[str]:
    """Return the addresses of ``trials``, or of every recording that a task uses.

    A library stands for those of its recordings that a task uses.
    """
    if not trials:
        return _used_by_tasks(library for library in archive.libraries if library != "gait")
    named = [_used_by_tasks([t]) if t in archive.libraries else [_address(t)] for t in trials]
    addresses = [uri for uris in named for uri in uris]
    if not all(named):
        unused = " and ".join(t for t, uris in zip(trials, named, strict=True) if not uris)
        raise UsageError(f"no task uses recordings of {unused}; name some, as LIBRARY:KEY")
    try:
        archive.status(addresses)
    except ValueError as error:
        raise UsageError(str(error)) from error
    return addresses


def _used_by_tasks(libraries: Iterable[str]) -> list[str]:
    """Return the addresses of all recordings of libraries that a task uses."""
    starts = tuple(f"{library}:" for library in libraries)
    cases = (case for name in bench.TASKS.names() for case in bench.TASKS.get(name).cases)
    return sorted({uri for case in cases for uri in case.recordings if uri.startswith(starts)})


def _address(trial: str) -> str:
    return trial if ":" in trial else f"cmu:{trial}"


def _show(rows: Sequence[RecordingStatus], data_dir: str | None, console: LiteralConsole) -> None:
    """Show one row a recording, with digests if one was computed, and the totals."""
    heads = [Column("recording", no_wrap=True), Column("state"), Column("where", overflow="fold")]
    if any(row.digest for row in rows):
        heads.append(Column("SHA-256", no_wrap=True))
    table = Table(*heads)
    for row in rows:
        cells = (row.uri, row.state, row.where, row.digest[:16])
        table.add_row(*cells[: len(heads)])
    console.print(table)
    console.print(bench.data_totals(rows, named_folders(data_dir)), soft_wrap=True)


def _suggest(
    rows: Sequence[RecordingStatus],
    trials: Sequence[str] | None,
    data_dir: str | None,
    plugin: Sequence[Path] | None,
    archive: Archive,
) -> None:
    """Say what to do next."""
    step = bench.next_data_step(rows, trials or (), named_folders(data_dir), plugin or (), archive)
    LiteralConsole().print(step, soft_wrap=True)
