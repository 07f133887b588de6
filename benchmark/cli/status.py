"""``mocapbench status``: the state of a run, also of one that is going on."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import DEFAULT_OUT, show_left_out
from mocapbench.benchmark.errors import ExitCode

if TYPE_CHECKING:
    from mocapbench.benchmark import RunState

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)


@app.command()
def status(
    run: Annotated[Path, typer.Argument(help="The run directory.")] = DEFAULT_OUT,
) -> None:
    """Show how far a run is, also one in another terminal.

    Exit code 3 says that jobs failed, and 4 that none has a result and no run is going on.
    """
    console, state = LiteralConsole(), bench.run_state(bench.RunDirectory(run))
    console.print(bench.state_table(state.tasks, state.total))
    for line in bench.state_lines(state, datetime.now(UTC)):
        console.print(line, highlight=False)
    show_left_out(state.damaged, console)
    raise typer.Exit(_exit_code(state))


def _exit_code(state: RunState) -> ExitCode:
    if state.total["failed"]:
        return ExitCode.JOBS_FAILED
    return ExitCode.OK if state.total["done"] or state.writing else ExitCode.NOTHING_RAN
