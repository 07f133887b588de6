"""Write the options of every command, in the words of their helps."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from typer.core import TyperCommand, TyperGroup
from typer.main import get_command

from mocapbench.benchmark.cli.commands import COMMANDS, app

if TYPE_CHECKING:  # tests read the tree where Sphinx is not installed
    from sphinx.application import Sphinx

__all__ = ["describe_commands", "find_commands", "setup", "tabulate_options"]


def setup(app: Sphinx) -> dict[str, bool]:
    """Have the text written when Sphinx begins; `docs/command-line.md` includes it."""
    app.connect("builder-inited", _write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def find_commands() -> dict[str, TyperCommand]:
    """Return every command by the words that call it, in the order of the help."""
    main = get_command(app)
    return dict(
        leaf
        for name in COMMANDS
        for leaf in _find_below(f"mocapbench {name}", main.get_command(None, name))
    )


def tabulate_options(command: TyperCommand) -> str:
    """Return a table of what a command takes."""
    rows = ["| option | what it says |", "|---|---|"]
    for parameter in command.params:
        is_option = parameter.opts[0].startswith("-")
        names = parameter.opts if is_option else [str(parameter.name).upper()]
        if "--help" not in names:
            default = f" Default: `{parameter.default}`." if _is_shown(parameter.default) else ""
            shown = ", ".join(f"`{name}`" for name in names)
            rows.append(f"| {shown} | {parameter.help}{default} |")
    return "\n".join(rows)


def describe_commands() -> str:
    """Return a section for each command: its sentence and its options."""
    return "\n\n".join(
        f"### `{words}`\n\n{(command.help or '').splitlines()[0]}\n\n{tabulate_options(command)}"
        for words, command in find_commands().items()
    )


def _find_below(words: str, command: object) -> Iterator[tuple[str, TyperCommand]]:
    if hasattr(command, "load"):
        command = command.load()
    if isinstance(command, TyperGroup):
        for name in command.commands:
            yield from _find_below(f"{words} {name}", command.commands[name])
    else:
        yield words, command


def _is_shown(default: object) -> bool:
    return isinstance(default, str | int | float | Path) and not isinstance(default, bool)


def _write(app: Sphinx) -> None:
    folder = Path(app.srcdir) / "generated"
    folder.mkdir(exist_ok=True)
    (folder / "commands.md").write_text(describe_commands() + "\n", encoding="utf-8")
