"""What `mocapbench --help` costs beside the libraries that print it (`tox -e speed`)."""

import subprocess
import sys

import pytest

COMMANDS = {
    "imports": ("-c", "import typer, rich"),
    "help": ("-c", "from mocapbench.benchmark.cli.main import main; main(['--help'])"),
}


@pytest.mark.parametrize("size", ["command line"])
@pytest.mark.parametrize("how", COMMANDS)
def test_a_fresh_process(benchmark, size, how):
    benchmark.group = size
    command = [sys.executable, *COMMANDS[how]]
    done = benchmark.pedantic(
        subprocess.run,
        args=[command],
        kwargs={"capture_output": True, "check": True},
        rounds=20,
        warmup_rounds=2,
    )
    assert (b"Usage: " in done.stdout) == (how == "help")
