"""The page of commands has every command and option, in the words of their helps."""

import re
from pathlib import Path

import pytest
from typer.core import TyperGroup
from typer.main import get_command

from mocapbench.benchmark.cli.commands import COMMANDS, app
from mocapbench.benchmark.errors import ExitCode

PAGE = (Path(__file__).parents[2] / "docs" / "command-line.md").read_text(encoding="utf-8")
MAIN = get_command(app)


def leaves(names, command):
    """Yield the words that call each command below one, and the command."""
    if hasattr(command, "load"):
        command = command.load()
    if isinstance(command, TyperGroup):
        for name in command.commands:
            yield from leaves(f"{names} {name}", command.commands[name])
    else:
        yield names, command


LEAVES = dict(
    leaf for name in COMMANDS for leaf in leaves(f"mocapbench {name}", MAIN.get_command(None, name))
)


def option_rows(command):
    """Return the rows of a table of what a command takes."""
    rows = ["| option | what it says |", "|---|---|"]
    for parameter in command.params:
        names = ", ".join(f"`{name}`" for name in _names(parameter) if name != "--help")
        default = f" Default: `{parameter.default}`." if _is_plain(parameter.default) else ""
        rows += [f"| {names} | {parameter.help}{default} |"] if names else []
    return "\n".join(rows)


def _names(parameter):
    return parameter.opts if parameter.opts[0].startswith("-") else [parameter.name.upper()]


def _is_plain(default):
    return isinstance(default, str | int | float | Path) and not isinstance(default, bool)


@pytest.mark.parametrize("names", LEAVES)
def test_a_command_stands_with_its_options(names):
    (section,) = re.findall(rf"^### `{names}`\n(.*?)(?=^##|\Z)", PAGE, re.DOTALL | re.MULTILINE)
    assert option_rows(LEAVES[names]) in section


def test_every_exit_code_is_explained():
    codes = re.findall(r"^\| (\d+) \| \S", PAGE, re.MULTILINE)
    assert codes == [str(code.value) for code in sorted(ExitCode)]
