"""Commands whose modules are imported when they are used, not when they are listed."""

from __future__ import annotations

import importlib
from typing import Any, ClassVar

from typer.core import TyperCommand, TyperGroup
from typer.main import get_command

from mocapbench.benchmark.errors import UnknownNameError

__all__ = ["DeferredCommand", "LazyGroup"]


class DeferredCommand(TyperCommand):
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


class LazyGroup(TyperGroup):
    """A group of commands of which only the names and the help are loaded."""

    commands_by_name: ClassVar[dict[str, DeferredCommand]] = {}

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
