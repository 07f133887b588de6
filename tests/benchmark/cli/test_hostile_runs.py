"""Run directories of others are data: whatever they hold, a command says what it is, and ends.

The damage is that of `docs/evidence/fuzz_runs.py`, which does more of it.
"""

import importlib.util
import random
import shutil
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mocapbench.basics.words import printable
from mocapbench.benchmark.runs.directory import RunDirectory

SCRIPT = Path(__file__).parents[3] / "docs" / "evidence" / "fuzz_runs.py"
spec = importlib.util.spec_from_file_location("fuzz_runs", SCRIPT)
fuzz_runs = importlib.util.module_from_spec(spec)
spec.loader.exec_module(fuzz_runs)

ROWS = [
    ("toy-interpolation-1", case, label, fold)
    for case in ("test 1", "test 2")
    for label in ("linear", "knn")
    for fold in range(2)
]
FINDING = {
    **{"task": ROWS[0][0], "version": 1, "case": "test 1", "label": "knn", "metric": "mse"},
    **{"verdict": "worse", "fails": True, "reason": "", "n": 2, "reference": 1.0, "run": 2.0},
    **{"change": 1.0, "allowance": 0.1, "worst": 1.5},
}


@pytest.fixture
def whole(write_run, tmp_path):
    path = write_run(tmp_path / "whole", ROWS)
    check = {"reference": "r.csv", "summary": "1 worse", "passed": False, "findings": [FINDING]}
    RunDirectory(path).save_check(check)
    return path


@pytest.fixture
def read(cli, whole, tmp_path):
    """Return a function that lets a command read a damaged run, which must end as documented."""

    def read(run, command):
        out = tmp_path / "out"
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir()
        commands = fuzz_runs.read_commands(run, whole, out)
        assert cli(*commands[command % len(commands)]) in fuzz_runs.ENDINGS
        assert "defect" not in cli.printed
        assert cli.printed == printable(cli.printed)
        return cli.printed

    return read


HOSTILE = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)


@HOSTILE
@given(seed=st.integers(0, 2**32), command=st.integers(0, 6))
def test_a_damaged_run_is_read_or_refused_in_words(read, whole, tmp_path, seed, command):
    run = tmp_path / "damaged"
    fuzz_runs.damage_copy(whole, run, random.Random(seed))
    read(run, command)


@HOSTILE
@given(seed=st.integers(0, 2**32))
def test_reading_all_of_a_damaged_run_raises_nothing_else(whole, tmp_path, seed):
    run = tmp_path / "damaged"
    fuzz_runs.damage_copy(whole, run, random.Random(seed))
    code, said = fuzz_runs.read_everything(run)
    assert code in fuzz_runs.ENDINGS, said


NAMES = {
    "plan": "plan.json",
    "keys": "keys.json",
    "check": "check.json",
    "marker": "mocapbench.json",
    "record": "records/*/*.json",
    "prediction": "predictions/*/*.npz",
}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("replace", fuzz_runs.REPLACEMENTS)
def test_what_is_no_file_is_not_opened_and_a_huge_one_not_read(read, whole, name, replace):
    path = next(whole.glob(NAMES[name]))
    path.unlink()
    replace(path)
    for command in (0, 1):
        read(whole, command)


def test_a_report_of_hostile_names_is_printable(cli, write_run, tmp_path):
    rows = [(*ROWS[0][:2], "kn\u202en\x1b[31m\x07", fold) for fold in range(2)]
    run = write_run(tmp_path / "run", rows)
    shutil.rmtree(run / "predictions")
    assert cli("report", "--out", run) == 0
    page = (run / "report.html").read_text(encoding="utf-8")
    assert page == printable(page)
    assert cli("export", run, "--to", tmp_path) == 0
    for table in ("scores", "jobs"):
        text = (tmp_path / f"{table}.csv").read_text(encoding="utf-8")
        assert text == printable(text)
    assert cli("compare", run, run, "--markdown", tmp_path / "m.md") in {0, 2}
    assert cli.printed == printable(cli.printed)


def test_predictions_of_another_problem_are_no_defect(cli, whole):
    assert cli("report", "--out", whole) == 0
    assert "damaged, so left out: predictions of linear: ValueError" in cli.printed
