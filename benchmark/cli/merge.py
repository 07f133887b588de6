"""``mocapbench merge``: several run directories become one."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench.basics.words import format_count
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import Plugins, load_plugins, show_left_out
from mocapbench.benchmark.errors import ExitCode

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)


@app.command()
def merge(
    runs: Annotated[list[Path], typer.Argument(help="Run directories; the first gives the order.")],
    out: Annotated[
        Path, typer.Option(help="The folder to write: new, empty, or a run, which takes part.")
    ],
    plugin: Plugins = None,
) -> None:
    """Merge run directories into one.

    Everything is checked first: if two runs have different scores for the same job, or different
    jobs for the same row of the tables, nothing is written.
    """
    load_plugins(plugin)
    console = LiteralConsole()
    merged = bench.merge(runs, out)
    show_left_out(merged.damaged, console)
    for path in merged.busy:
        console.print(f"a run is writing to {path}: what it writes from now on is not merged")
    jobs = format_count(len(merged.plan["keys"]), "job")
    records = format_count(len(merged.records), "record")
    fits = format_count(len(merged.fits), "set of predictions", "sets of predictions")
    console.print(f"{out}: {jobs}, {records}, {fits}", soft_wrap=True)
    console.print(f"write its report with `mocapbench report --out {out}`", soft_wrap=True)
    if not merged.records:
        raise typer.Exit(ExitCode.NOTHING_RAN)
