"""The example of a third-party package, built and used as the separate package that it is."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[3] / "examples" / "third-party"
MAIN = "from mocapbench.benchmark.cli.main import main; main()"

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    """Return a copy of the example, which building leaves files in."""
    folder = tmp_path_factory.mktemp("third-party") / "source"
    ignored = shutil.ignore_patterns("build", ".tox", "*.egg-info", "results")
    return shutil.copytree(EXAMPLE, folder, ignore=ignored)


@pytest.fixture(scope="module")
def python(source):
    """Return a function that runs Python where the example is installed."""
    site = source.parent / "site"
    environment = {**os.environ, "PYTHONPATH": str(site), "COLUMNS": "200"}

    def run(*arguments):
        """Return the exit code and what was printed."""
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

    offline = ("--no-deps", "--no-build-isolation", "--no-index", "--disable-pip-version-check")
    code, printed = run("-m", "pip", "install", *offline, "--target", site, source)
    assert code == 0, printed
    return run


@pytest.fixture(scope="module")
def results(python):
    models = ("--models", "straight-lines,cubic-spline,trivial")
    chosen = ("--profile", "smoke", "--tasks", "waves", *models, "--offline", "--jobs", 2)
    code, printed = python("-c", MAIN, "run", *chosen, "--out", "results")
    assert code == 0, printed
    return "results"


def test_what_it_adds_is_listed_and_keeps_the_protocols(python):
    added = {"models": "straight-lines", "tasks": "waves", "metrics": "median_absolute_error"}
    for kind, name in added.items():
        code, printed = python("-c", MAIN, "list", kind)
        assert code == 0
        assert name in printed
    code, printed = python("-m", "pytest", "tests", "-q", "-p", "no:cacheprovider")
    assert code == 0, printed


def test_its_metrics_are_as_good_as_its_reference_values(python, results):
    arguments = ("--reference", "reference", "--tolerances", "tolerances.toml")
    code, printed = python("-c", MAIN, "check", results, *arguments)
    assert code == 0, printed
    assert " same" in printed


def test_a_metric_of_its_own_that_got_worse_is_seen(source, python, results):
    """As if the reference values had been better than the run's."""
    recorded = (source / "reference" / "waves.csv").read_text()
    better = re.sub(r"(straight-lines,median_absolute_error,)[^,]*", r"\g<1>0.001", recorded)
    assert better != recorded
    (source / "better.csv").write_text(better)
    arguments = ("--reference", "better.csv", "--environment", "same")
    code, printed = python("-c", MAIN, "check", results, *arguments)
    assert code == 1, printed
    assert "straight-lines" in printed
    assert "median_absolute_error" in printed
