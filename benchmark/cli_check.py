"""The command ``check``: whether what a run found can be believed."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from mocapbench.benchmark.errors import ExitCode, UsageError
from mocapbench.benchmark.store import Store

__all__ = ["check"]


def check(
    run: Annotated[Path, typer.Argument(help="The run directory.")] = Path("mocapbench-results"),
    controls: Annotated[
        bool, typer.Option("--controls", help="Do samples surpass those of the control?")
    ] = False,
) -> None:
    """Check the last run of a run directory; exit code 1 if it fails."""
    if not controls:
        raise UsageError("expected something to check, got nothing: choose --controls")
    # Reports take a second to import, which every command would pay.
    from mocapbench.benchmark.controls import check_controls  # noqa: PLC0415

    store, console = Store.open(run), Console()
    keys = store.load_plan()["keys"]
    records = [record for key in keys if (record := store.load(key)) is not None]
    for message in store.damaged:
        console.print(f"damaged, so left out: {message}", markup=False)
    code = check_controls(records, console)
    if code is not ExitCode.OK:
        raise typer.Exit(code)
