"""Commands, whose modules are imported when they are used, not when they are listed."""

from __future__ import annotations

import importlib
from typing import Annotated, Any, ClassVar

import typer
from typer.core import TyperCommand, TyperGroup
from typer.main import get_command

from mocapbench import __version__
from mocapbench.benchmark.errors import UnknownNameError, UsageError
from mocapbench.benchmark.files import words_of

__all__ = ["COMMANDS", "app"]

COMMANDS = {
    "run": "Run the benchmark and write its report.",
    "inspect": "Say what a technician would look for in your own recordings.",
    "fill": "Fill the gaps of your own recordings.",
    "init": "Write a task file for recordings of your own.",
    "status": "Show how far a run is, also one in another terminal.",
    "merge": "Merge run directories into one.",
    "report": "Write the HTML report of a run, or of changes between two.",
    "motion": "Write the motion that a model made as GIF, AMC, BVH or CSV.",
    "check-model": "Check that your own models keep what their abilities promise.",
    "models": "List models that are commands, and install what they need.",
    "check": "Check that no metric of a run is worse than its reference.",
    "compare": "Compare two runs, or two models of one run, by paired folds.",
    "power": "Say which difference how many people can show.",
    "data": "Look for, fetch and verify recordings.",
    "export": "Write the scores and jobs of a run, or tables for papers.",
    "submit": "Write the records of a run as an archive for a leaderboard.",
    "leaderboard": "Build a site of what several laboratories have sent.",
    "figures": "Draw figures for a paper or slides, each with its data.",
    "list": "List tasks, models, metrics, libraries or formats of files.",
    "info": "Show versions, the machine, and how to cite.",
}


class _DeferredCommand(TyperCommand):
    """A command that is known by its name and help, and imported when it is called.

    Parameters
    ----------
    module : str
        A module with a `typer.Typer` called ``app``.
    name, help : str
        What the list of commands shows.
    """

    def __init__(self, module: str, name: str, help: str) -> None:  # noqa: A002
        super().__init__(name, help=help, callback=None)
        self.module = module

    def load(self) -> Any:
        """Import the command."""
        return get_command(importlib.import_module(self.module).app)

    def make_context(self, *args: Any, **extra: Any) -> Any:
        """Import the command and let it parse its arguments; completion starts here too."""
        return self.load().make_context(*args, **extra)


class _Commands(TyperGroup):
    """A group of commands of which only the names and the help are loaded."""

    commands_by_name: ClassVar[dict[str, _DeferredCommand]] = {
        name: _DeferredCommand(f"{__package__}.{name.replace('-', '_')}", name, text)
        for name, text in COMMANDS.items()
    }

    def list_commands(self, ctx: Any) -> list[str]:
        """Return the names, in the order of the help."""
        del ctx
        return list(self.commands_by_name)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Return the command without importing it; None if there is none of that name."""
        del ctx
        return self.commands_by_name.get(cmd_name)

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Return the command that ``args`` begin with.

        Raises
        ------
        UnknownNameError
            If there is none of that name; the message suggests the nearest.
        """
        if args[0] not in self.commands_by_name and not ctx.resilient_parsing:
            raise UnknownNameError("command", args[0], list(self.commands_by_name))
        return super().resolve_command(ctx, args)

    def invoke(self, ctx: Any) -> Any:
        """Run the command.

        Of the two errors, typer would believe that the terminal was closed, and exit with 1.
        """
        try:
            return super().invoke(ctx)
        except BrokenPipeError as error:
            raise UsageError(f"cannot read or write: {words_of(error)}") from error
        except EOFError as error:
            raise RuntimeError("an end of data where more was expected") from error


app: typer.Typer = typer.Typer(
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
