"""The command line answers at once where it computes nothing."""

import json
import os
import subprocess
import sys

import pytest

HEAVY = ("matplotlib", "numpy", "pandas", "pebble", "scipy", "seaborn", "sklearn")
SCRIPT = f"""
import atexit, json, sys
sys.argv = ["mocapbench", *sys.argv[1:]]
loaded = lambda: json.dumps([name for name in {HEAVY!r} if name in sys.modules])
atexit.register(lambda: print(loaded(), file=sys.stderr))
from mocapbench.benchmark.cli.main import main
main()
"""


def _run(*arguments, **environment):
    """Run the command line in a fresh process; return its code, its output and what it loaded."""
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, *arguments],
        env={**os.environ, "COLUMNS": "200", **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    *printed, loaded = done.stderr.splitlines()
    assert "Traceback" not in done.stderr
    return done.returncode, done.stdout + "\n".join(printed), json.loads(loaded)


@pytest.mark.parametrize(
    ("arguments", "shown"),
    [
        (("--help",), "Compare two runs, or two models of one run"),
        (("--version",), "mocapbench "),
        (("run", "--help"), "--dry-run"),
        (("inspect", "--help"), "--json"),
        (("fill", "--help"), "--max-gap"),
        (("status", "--help"), "in another terminal"),
        (("merge", "--help"), "Everything is checked first"),
        (("report", "--help"), "The HTML file to write"),
        (("motion", "--help"), "Folds are counted from 1"),
        (("check", "--help"), "--reference"),
        (("compare", "--help"), "--rope"),
        (("power", "--help"), "--people"),
        (("data", "--help"), "verify"),
        (("export", "--help"), "Folder of the files"),
        (("submit", "--help"), "neither recordings nor"),
        (("leaderboard", "--help"), "Everything is checked first"),
        (("list", "--help"), "libraries"),
        (("info", "--help"), "how to cite"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_help_loads_no_numerical_library(arguments, shown):
    code, printed, loaded = _run(*arguments)
    assert code == 0
    assert shown in printed
    assert loaded == []


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("mocapbench ru", {"run"}),
        ("mocapbench c", {"check", "check-model", "compare"}),
        ("mocapbench st", {"status"}),
        ("mocapbench me", {"merge"}),
        ("mocapbench run --pro", {"--profile"}),
        ("mocapbench run --expl", {"--explain"}),
        ("mocapbench run --log", {"--log-json"}),
        ("mocapbench merge --ou", {"--out"}),
        ("mocapbench check --refer", {"--reference"}),
        ("mocapbench compare --ro", {"--rope"}),
        ("mocapbench data ver", {"verify"}),
    ],
)
def test_completion_in_a_shell_loads_no_numerical_library(words, expected):
    position = str(len(words.split()) - 1)
    code, printed, loaded = _run(
        _MOCAPBENCH_COMPLETE="complete_bash", COMP_WORDS=words, COMP_CWORD=position
    )
    assert code == 0
    assert set(printed.split()) == expected
    assert loaded == []


@pytest.mark.parametrize("kind", ["tasks", "models", "metrics", "libraries", "formats"])
def test_lists_load_neither_models_nor_tables(kind):
    code, _, loaded = _run("list", kind)
    assert code == 0
    assert {*loaded} <= {"numpy", "scipy"}


def test_the_status_of_a_run_loads_neither_models_nor_tables(tmp_path):
    task = ("--tasks", "toy-interpolation-1", "--models", "trivial", "--profile", "smoke")
    assert _run("run", *task, "--out", str(tmp_path / "run"))[0] == 0
    code, printed, loaded = _run("status", str(tmp_path / "run"))
    assert code == 0
    assert "toy-interpolation-1" in printed
    assert {*loaded} <= {"numpy", "scipy"}


def test_who_resumes_a_finished_run_starts_no_worker(tmp_path):
    task = ("--tasks", "toy-interpolation-1", "--models", "trivial", "--profile", "smoke")
    resume = ("run", *task, "--no-report", "--out", str(tmp_path / "run"))
    assert _run(*resume)[0] == 0
    code, printed, loaded = _run(*resume)
    assert code == 0
    assert "jobs are in" in printed
    assert "pebble" not in loaded


def test_who_resumes_a_finished_run_loads_neither_models_nor_tables(tmp_path):
    task = ("--tasks", "toy-interpolation-1", "--models", "trivial", "--profile", "smoke")
    resume = ("run", *task, "--out", str(tmp_path / "run"))
    assert _run(*resume)[0] == 0
    code, printed, loaded = _run(*resume)
    assert code == 0
    assert "nothing new; report" in printed
    assert {*loaded} <= {"numpy", "scipy"}


@pytest.mark.slow
def test_what_computes_does_load_them():
    """Else the tests above would prove nothing."""
    code, printed, loaded = _run("list", "models", "cubic-spline")
    assert code == 0
    assert "cubic-spline" in printed
    assert {"numpy", "scipy"} <= set(loaded)
