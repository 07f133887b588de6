"""``mocapbench submit``: the records of a run as one archive for a leaderboard."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench.basics.words import format_count
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import DEFAULT_OUT, require_writable, show_left_out
from mocapbench.benchmark.errors import UsageError

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)


@app.command()
def submit(
    run: Annotated[Path, typer.Argument(help="The run directory.")] = DEFAULT_OUT,
    by: Annotated[str, typer.Option(help="Who ran it: a person or a laboratory.")] = "",
    link: Annotated[str | None, typer.Option(help="The address of a page about them.")] = None,
    models: Annotated[
        Path | None,
        typer.Option(help="A TOML file: [LABEL] with paper, code and licence of your models."),
    ] = None,
    to: Annotated[Path, typer.Option(help="The archive to write.")] = Path("submission.zip"),
) -> None:
    """Write the records of a run as an archive for a leaderboard.

    It has scores, versions, the machine and digests of recordings; neither recordings nor
    predictions.
    """
    if not by.strip():
        raise UsageError('--by: expected who ran it, got nothing; add --by "Your laboratory"')
    if to.exists():
        raise UsageError(f"--to: expected no file called {to}; name another, or delete it")
    require_writable(to)
    store, console = bench.RunDirectory(run), LiteralConsole()
    n_records = bench.write_submission(store, to, by.strip(), link, bench.read_models(models))
    console.print(
        f"{to}: {format_count(n_records, 'record')}, {to.stat().st_size / 1e6:.1f} MB, with the "
        "command line of the run and the names of its recordings",
        soft_wrap=True,
    )
    if lacking := len(store.load_plan()["keys"]) - n_records:
        console.print(
            f"without a record: {format_count(lacking, 'job')}; `mocapbench run` computes them",
            soft_wrap=True,
        )
    show_left_out(store.damaged, console)
