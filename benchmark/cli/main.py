"""The command line's entrance: it dispatches to one module per command."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Sequence
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape

from mocapbench import __version__, datasets
from mocapbench.benchmark.cli.lazy import DeferredCommand, LazyGroup
from mocapbench.benchmark.errors import ExitCode, UsageError

__all__ = ["COMMANDS", "app", "main"]

COMMANDS = {
    "run": "Run the benchmark and write its report; what the run directory holds is not run again.",
    "report": "Write the HTML report of a run directory.",
    "check": "Compare a run with reference values, fold by fold; exit code 1: a metric got worse.",
    "compare": "Set two runs, or two models of one run, against each other, fold by fold.",
    "data": "Look for, fetch and verify recordings.",
    "export": "Write everything in a run directory, scores and jobs, as tables.",
    "list": "List the registered tasks, models, metrics or libraries of recordings.",
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
    """Run the command line; user errors become one clear line and exit code 2."""
    console = Console(stderr=True)
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="replace")  # type: ignore[union-attr]  # terminals that know ASCII only
    try:
        app(args=None if arguments is None else list(arguments))
    except SystemExit:  # first, since the names of the errors below take time to import
        raise
    except (UsageError, datasets.DigestMismatch, datasets.AcclaimError) as error:
        console.print(f"[bold red]error:[/] {escape(str(error))}", soft_wrap=True)
        sys.exit(ExitCode.USAGE)
    except OSError as error:
        console.print(f"[bold red]error:[/] cannot read or write: {escape(str(error))}")
        sys.exit(ExitCode.USAGE)
    except Exception:  # else the interpreter's exit code would say that a metric got worse
        traceback.print_exc()
        console.print("[bold red]error:[/] a defect of mocapbench or an added package; see above")
        sys.exit(ExitCode.DEFECT)
