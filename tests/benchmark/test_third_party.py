"""The example of a third-party package, built and used as the separate package that it is."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[2] / "examples" / "third-party"
MAIN = "from mocapbench.benchmark.cli import main; main()"

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def python(tmp_path_factory):
    """Return a function that runs Python where the example is installed, and its output."""
    folder = tmp_path_factory.mktemp("third-party")
    source, site = folder / "source", folder / "site"
    shutil.copytree(EXAMPLE, source, ignore=shutil.ignore_patterns("build", ".tox", "*.egg-info"))
    options = ("--no-deps", "--no-build-isolation", "--no-index", "--disable-pip-version-check")
    environment = {**os.environ, "PYTHONPATH": str(site), "COLUMNS": "200"}

    def run(*arguments):
        done = subprocess.run(
            [sys.executable, *map(str, arguments)],
            cwd=source,
            env=environment,
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
        return done.returncode, done.stdout + done.stderr

    code, printed = run("-m", "pip", "install", *options, "--target", site, source)
    assert code == 0, printed
    return run


@pytest.fixture(scope="module")
def results(python):
    chosen = (
        "--profile",
        "smoke",
        "--tasks",
        "waves",
        "--models",
        "straight-lines,cubic-spline,trivial",
    )
    out = ("--offline", "--jobs", 2, "--out", "results")
    code, printed = python("-c", MAIN, "run", *chosen, *out)
    assert code == 0, printed
    return "results"


@pytest.mark.parametrize(
    ("kind", "name"),
    [("models", "straight-lines"), ("tasks", "waves"), ("metrics", "median_absolute_error")],
)
def test_what_it_adds_is_listed(python, kind, name):
    code, printed = python("-c", MAIN, "list", kind)
    assert code == 0
    assert name in printed


def test_its_own_tests_pass(python):
    code, printed = python("-m", "pytest", "tests", "-q", "-p", "no:cacheprovider")
    assert code == 0, printed


def test_its_metrics_are_as_good_as_its_baseline_says(python, results):
    arguments = ("--baseline", "baseline", "--tolerances", "tolerances.toml")
    code, printed = python("-c", MAIN, "check", results, *arguments)
    assert code == 0, printed
    assert " same" in printed


def test_a_model_of_its_own_that_got_worse_is_seen(python, results):
    """The baseline says that it was better: the gate must say so of its own metric too."""
    script = (
        "from pathlib import Path; path = Path('baseline/waves.csv'); "
        "import re; text = path.read_text(); "
        "better = re.sub(r'(straight-lines,median_absolute_error,)[^,]*', r'\\g<1>0.001', text); "
        "assert better != text; Path('better.csv').write_text(better)"
    )
    assert python("-c", script) == (0, "")
    arguments = ("--baseline", "better.csv", "--environment", "same")
    code, printed = python("-c", MAIN, "check", results, *arguments)
    assert code == 1, printed
    assert "straight-lines" in printed
    assert "median_absolute_error" in printed
