import json
from pathlib import Path

import pytest

from mocapbench.benchmark.cli.main import main


class CommandLine:
    """Runs the command line in this process and keeps what it printed."""

    def __init__(self, capsys):
        self.capsys = capsys
        self.printed = ""

    def __call__(self, *arguments):
        """Return the exit code."""
        self.capsys.readouterr()
        with pytest.raises(SystemExit) as ended:
            main([str(argument) for argument in arguments])
        captured = self.capsys.readouterr()
        self.printed = " ".join((captured.out + captured.err).split())
        assert "Traceback" not in self.printed
        return int(ended.value.code or 0)


@pytest.fixture
def cli(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    return CommandLine(capsys)


@pytest.fixture
def broken_models():
    return Path(__file__).with_name("broken_models.py")


def _records(out):
    documents = [json.loads(p.read_text()) for p in (Path(out) / "records").rglob("*.json")]
    return {(d["task"], d["case"], d["label"], d["fold"]): d for d in documents}


@pytest.fixture
def records():
    """Return a function from a run directory to its records, by address."""
    return _records
