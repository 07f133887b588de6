"""The examples and commands of the README work as they stand."""

import re
import shlex
from pathlib import Path

import pytest

README = (Path(__file__).parents[3] / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
COMMANDS = [
    shlex.split(line, comments=True)[1:]
    for line in re.findall(r"^mocapbench .*$", README, re.MULTILINE)
]


@pytest.mark.parametrize("option", ["--plugin", "--model-file"])
def test_its_model_runs(cli, records, tmp_path, option):
    (source,) = (block for block in BLOCKS if "MODELS" in block)
    path = tmp_path / "my_model.py"
    path.write_text(source)
    toy = ("--profile", "smoke", "--tasks", "toy-interpolation-1", "--offline")
    chosen = ("--models", "channel-mean", option, path)
    assert cli("run", *toy, *chosen, "--out", tmp_path / "run") == 0
    assert all(record["scores"]["mse"] > 0 for record in records(tmp_path / "run").values())


def test_its_engine_runs(capsys):
    (source,) = (block for block in BLOCKS if "MODELS" not in block)
    shown = {}
    exec(source, shown)
    assert "billion operations" in capsys.readouterr().out
    assert shown["filled"].mean.shape == (30, 2)
    assert shown["curves"].shape == shown["new_walks"].shape == (25, 30, 2)


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_its_commands_are_understood(cli, command):
    """The help of each command exists, and lists the options shown."""
    names = [word for word in command if word.startswith("--")]
    positional = [word for word in command[:2] if not word.startswith("--")]
    with_help = positional[: 2 if positional[:1] == ["data"] else 1]
    assert cli(*with_help, "--help") == 0
    assert all(name in cli.printed for name in names)
