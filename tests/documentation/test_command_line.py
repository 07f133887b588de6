"""The page of commands explains every exit code, and its generated part has every option."""

import re
from pathlib import Path

import commands
import pytest

from mocapbench.benchmark.cli.commands import COMMANDS
from mocapbench.benchmark.errors import ExitCode

PAGE = (Path(__file__).parents[2] / "docs" / "command-line.md").read_text(encoding="utf-8")
FOUND = commands.find_commands()


def test_every_command_is_described():
    assert {words.split()[1] for words in FOUND} == set(COMMANDS)
    text = commands.describe_commands()
    assert all(f"### `{words}`\n" in text for words in FOUND)


@pytest.mark.parametrize("words", FOUND)
def test_a_table_has_every_option_with_its_help(words):
    rows = commands.tabulate_options(FOUND[words]).splitlines()[2:]
    options = [each for each in FOUND[words].params if "--help" not in each.opts]
    assert len(rows) == len(options)
    for row, option in zip(rows, options, strict=True):
        assert option.help
        assert f" | {option.help}" in row


def test_every_exit_code_is_explained():
    codes = re.findall(r"^\| (\d+) \| \S", PAGE, re.MULTILINE)
    assert codes == [str(code.value) for code in sorted(ExitCode)]
