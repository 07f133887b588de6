"""The example of a plug-in, used as a user would: one file, from a folder of one's own."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from mocapbench.benchmark.plugins import load_plugin
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.benchmark.testing import check_metric, check_model, check_task

PLUGIN = Path(__file__).parents[2] / "examples" / "plugin" / "pendulums.py"


def mocapbench(folder, *arguments):
    """Return what the command printed; it must succeed."""
    command = [sys.executable, "-m", "mocapbench.benchmark.cli.main", *map(str, arguments)]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_it_is_short_enough_to_read():
    assert len(PLUGIN.read_text(encoding="utf-8").splitlines()) <= 96


def test_its_parts_conform():
    load_plugin(PLUGIN)
    check_model(MODELS.get("linear-dynamics"))
    check_task(TASKS.get("pendulums"))
    check_metric(METRICS.get("worst_error"))


@pytest.mark.slow
def test_from_one_file_one_runs_reports_checks_and_compares(tmp_path):
    plugin = ("--plugin", PLUGIN)
    mocapbench(
        tmp_path,
        *("run", *plugin, "--tasks", "pendulums", "--offline", "--out", "run"),
        *("--models", "linear-dynamics,cubic-spline,trivial"),
    )
    documents = [json.loads(p.read_text()) for p in (tmp_path / "run" / "records").rglob("*.json")]
    assert len(documents) == 3 * 3 * 3
    assert all(document["status"] == "ok" for document in documents)
    assert all(document["scores"]["worst_error"] >= 0 for document in documents)
    page = (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    assert "linear-dynamics" in page
    assert "Worst error" in page
    assert "Error along the gap" in page
    check = ("check", "run", "--reference", "values", *plugin)
    mocapbench(tmp_path, *check, "--update")
    assert " same; same environment" in " ".join(mocapbench(tmp_path, *check).split())
    models = ("--models", "linear-dynamics,cubic-spline")
    compared = mocapbench(tmp_path, "compare", "run", *models, *plugin)
    assert "Worst error" in compared
    assert "pendulums:long" in mocapbench(tmp_path, "data", "status", *plugin)
    assert "pendulums" in mocapbench(tmp_path, "list", "libraries", *plugin)
    mocapbench(tmp_path, "report", "--out", "run", *plugin)
