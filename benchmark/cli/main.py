"""The command line's entrance: it dispatches to one module per command."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from mocapbench import __version__
from mocapbench.benchmark import cli
from mocapbench.benchmark.cli.lazy import DeferredCommand, LazyGroup
from mocapbench.benchmark.errors import ExitCode

__all__ = ["COMMANDS", "app", "main"]

COMMANDS = {
    "run": "Run the benchmark and write its report.",
    "fill": "Fill the gaps of your own recordings.",
    "init": "Write a task file for recordings of your own.",
    "status": "Show how far a run is, also one in another terminal.",
    "merge": "Merge run directories into one.",
    "report": "Write the HTML report of a run, or of what changed between two.",
    "motion": "Write the motion that a model made as GIF, AMC, BVH or CSV.",
    "check": "Check that no metric of a run is worse than its reference value.",
    "compare": "Compare two runs, or two models of one run, by paired folds.",
    "data": "Look for, fetch and verify recordings.",
    "export": "Write the scores and jobs of the last run as tables.",
    "list": "List tasks, models, metrics, libraries or formats of files.",
    "info": "Show versions, the machine, and how to cite.",
}


class _Commands(LazyGroup):
    commands_by_name = {  # noqa: RUF012
        name: DeferredCommand(f"{__package__}.{name}", name, text)
        for name, text in COMMANDS.items()
    }


app = typer.Typer(
    name="mocapbench",
    help="Reproducible benchmarks of models of human motion.",
    cls=_Commands,
    no_args_is_help=True,
    rich_markup_mode=None,  # panels would double what `--help` costs; commands have them
    pretty_exceptions_enable=False,
)


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"mocapbench {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version."),
    ] = False,
) -> None:
    """Reproducible benchmarks of models of human motion."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line; errors become one line and an exit code."""
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="replace")  # type: ignore[union-attr]  # terminals that know ASCII only
    with warnings.catch_warnings():  # which puts the function back
        warnings.showwarning = _showing_each_once()
        try:
            app(args=None if arguments is None else list(arguments))
        except Exception as error:
            sys.exit(_explained(error))


def _explained(error: Exception) -> int:
    try:
        return cli.explain(error)
    except OSError:  # the terminal was closed, and what could not be written is lost with it
        with Path(os.devnull).open("w", encoding="utf-8") as nowhere:
            for stream in (sys.stdout, sys.stderr):
                os.dup2(nowhere.fileno(), stream.fileno())
        return ExitCode.INTERRUPTED


def _showing_each_once() -> Callable[..., None]:
    """Return what shows warnings; Python forgets those it showed when its filters change."""
    shown: set[tuple[str, type[Warning]]] = set()

    def show(message: Warning | str, category: type[Warning], *origin: Any) -> None:
        if (str(message), category) not in shown:
            shown.add((str(message), category))
            cli.show_warning(message, category, *origin)  # imported late, as it takes time

    return show


if __name__ == "__main__":
    main()
