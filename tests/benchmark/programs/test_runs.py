"""Commands take part in `run`, `fill` and `check-model`, and end when their job does."""

import csv
import os
import re

import psutil
import pytest
from own_files import write_csv
from shell_models import ONES

pytestmark = pytest.mark.slow

LONG = f"{600 + os.getpid() / 10**7:.7f}"  # of no other worker of the tests
SCRIPTS = {
    "good": ONES,
    "waits": f"echo at step 1 >&2; exec sleep {LONG}",
    "leaves": f"{ONES}sleep {LONG} & exit 0",
    "dies": "echo no licence >&2; exit 3",
    "takes": "echo learning >&2; exec tail /dev/zero",
}
ENDINGS = {
    "good": ("ok", ""),
    "waits": (
        "timeout",
        r"to end within 2\d\.?\d* s, got no end; it said: at step 1; raise --timeout",
    ),
    "leaves": ("ok", ""),
    "dies": ("failed", "to end with exit code 0, got 3; it said: no licence"),
    "takes": (
        "out-of-memory",
        r"needed more than its 1\.0 GiB; .*takes\.sh fill FOLDER` to take at most 1\.0 GiB of",
    ),
}


@pytest.fixture
def commands(tmp_path):
    """Return the options that name a TOML file for each script, and where the scripts are."""
    folder = tmp_path / "commands"
    folder.mkdir()
    for name, script in SCRIPTS.items():
        (folder / f"{name}.sh").write_text(script)
        (folder / f"{name}.toml").write_text(
            f'name = "{name}"\ncommand = ["sh", "{name}.sh"]\nfiles = ["{name}.sh"]\n'
            'format = "csv"\nprovides = ["fills entries", "fills new recordings"]\nseeds = 2\n'
        )
    return [word for name in SCRIPTS for word in ("--plugin", folder / f"{name}.toml")]


def find_sleepers():
    return [p for p in psutil.process_iter(["cmdline"]) if p.info["cmdline"] == ["sleep", LONG]]


def find_times(run):
    """Return when each record was written, by its key."""
    return {path.stem: path.stat().st_mtime_ns for path in (run / "records").rglob("*.json")}


def test_each_ending_is_recorded_and_nothing_is_left(cli, records, commands, tmp_path):
    run = ("run", "--profile", "smoke", "--tasks", "toy-interpolation-1", "--cases", "test 1")
    run = (*run, "--folds", 1, "--offline", "--no-report", "--jobs", 1, *commands)
    run = (*run, "--memory", 1, "--timeout", 30, "--out", tmp_path / "run")
    assert cli(*run, "--models", ",".join(SCRIPTS)) == 3
    found = {label: record for (_, _, label, _), record in records(tmp_path / "run").items()}
    assert {label: record["status"] for label, record in found.items()} == {
        label: status for label, (status, _) in ENDINGS.items()
    }
    for label, (_, message) in ENDINGS.items():
        assert re.search(message, found[label]["message"])
    assert find_sleepers() == []
    good, leaves = (found[label]["key"] for label in ("good", "leaves"))
    written = find_times(tmp_path / "run")
    with (tmp_path / "commands" / "good.sh").open("a") as script:
        script.write("true\n")
    assert cli(*run, "--models", "good,leaves") == 0
    again = find_times(tmp_path / "run")
    assert again[leaves] == written[leaves]
    (new,) = again.keys() - written.keys()
    assert new != good


def test_gaps_of_a_file_are_filled(cli, commands, tmp_path):
    walk = write_csv(tmp_path / "walk.csv", gaps=[(20, 26, 0)])
    fill = ("fill", walk, *commands, "--out", tmp_path / "out", "--model")
    assert cli(*fill, "good") == 0
    with (tmp_path / "out" / "walk.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert {float(row["hip.x"]) for row in rows[20:26]} == {1.0}
    assert cli(*fill, "dies", "--force") == 2 or "no licence" in cli.printed


def test_a_file_is_checked_from_the_command_line(cli, commands, tmp_path):
    good, dies = (tmp_path / "commands" / f"{name}.toml" for name in ("good", "dies"))
    assert cli("check-model", good) == 0
    assert "good fills any mask: ok" in cli.printed
    assert "good-2" not in cli.printed  # which is the same with another seed
    assert ": 0 failed" in cli.printed
    assert cli("check-model", dies) == 2
    assert "dies fills any mask: expected that hidden entries are filled" in cli.printed
    assert "got 3; it said: no licence" in cli.printed


def test_what_hangs_is_told_when_it_is_checked(cli, commands, tmp_path):
    assert cli("check-model", tmp_path / "commands" / "waits.toml", "--timeout", 6) == 2
    assert "got no end; it said: at step 1" in cli.printed
    assert find_sleepers() == []


def test_a_file_without_models_is_not_checked(cli, tmp_path):
    (tmp_path / "mine.py").write_text(
        "from mocapbench.datasets import CSVFormat\n"
        "class Table(CSVFormat):\n    suffixes = ('.t',)\n"
        "FORMATS = {'t': Table}\n"
    )
    assert cli("check-model", tmp_path / "mine.py") == 2
    assert "expected files that define models, got none" in cli.printed
