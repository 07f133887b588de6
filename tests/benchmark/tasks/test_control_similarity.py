"""Real motions compared with each other."""

import os
from collections import Counter
from pathlib import Path

import pytest

from mocapbench.baselines import Replay
from mocapbench.benchmark import METRICS, TASKS, archive_at
from mocapbench.benchmark.runs.request import entrants

TASK = TASKS.get("control-similarity")
GOLDENS = Path(__file__).parents[2] / "goldens"


@pytest.fixture(scope="module")
def similarity(posed):
    """Return a function from a case to its MCC and MLC."""

    def score(case):
        problem = posed(TASK.name, case)
        outcome = problem.outcome(problem.solve(problem.fit(Replay()), 0))
        return {name: METRICS.get(name)(outcome).value for name in ("mcc", "mlc")}

    return score


def test_rows_of_one_recording_are_fitted_once(cli, tmp_path):
    arguments = ("--tasks", TASK.name, "--cases", "synthetic 1 vs *", "--offline")
    assert cli("run", *arguments, "--out", tmp_path) == 0
    assert len(list((tmp_path / "records").rglob("*.json"))) == 2
    assert len(list((tmp_path / "predictions").rglob("*.npz"))) == 1


def test_real_recordings_are_replayed_and_no_model_takes_part():
    assert [entrant.label for entrant in entrants(TASK)] == ["replay"]


def test_a_recording_is_like_itself_and_likeness_is_mutual(similarity):
    itself = similarity("synthetic 1 vs synthetic 1")
    one, other = (similarity(f"synthetic {a} vs synthetic {b}") for a, b in ((1, 2), (2, 1)))
    assert itself["mlc"] == pytest.approx(1.0)
    assert one == pytest.approx(other)
    assert one["mcc"] < itself["mcc"]


def test_pairs_are_those_of_the_four_tables():
    rows, columns = (Counter(c.columns[key] for c in TASK.cases) for key in TASK.page.crossed)
    assert {rows[name] for name in ("12(1)", "16(15)", "38(2)", "35(1)", "39(4)")} == {10}
    assert {columns[name] for name in ("12(1)", "38(2)", "10(5)", "11(1)")} == {5}


@pytest.mark.slow
@pytest.mark.recordings
@pytest.mark.skipif("MOCAPBENCH_DATA" not in os.environ, reason="MOCAPBENCH_DATA names nothing")
def test_real_recordings_are_as_similar_as_they_were(similarity, num_regression):
    available = archive_at().available
    real = [case for case in TASK.cases if not case.synthetic]
    scores = [similarity(case.name) for case in real if all(map(available, case.recordings))]
    values = {name: [each[name] for each in scores] for name in ("mcc", "mlc")}
    golden = GOLDENS / "control-similarity.csv"
    num_regression.check(values, default_tolerance={"rtol": 1e-9, "atol": 1e-12}, fullpath=golden)
