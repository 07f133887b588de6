"""Missing frames against GPDM Table 2, on the recordings that are here."""

import os
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.runs.solve import build_model
from mocapbench.benchmark.tasks.missing_frames import N_WINDOWS
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import open_archive
from mocapbench.reports.paper.published import published_values

TASK = TASKS.get("missing-frames")
ROWS = ("35-03", "16-21", "07-01", "07-02", "08-01", "08-02")
GOLDENS = Path(__file__).parents[2] / "goldens"

pytestmark = [
    pytest.mark.recordings,
    pytest.mark.skipif(
        "MOCAPBENCH_DATA" not in os.environ, reason="MOCAPBENCH_DATA names no recordings"
    ),
]


@cache
def _problem(row, fold):
    case = TASK.case(f"{row} three-walkers")
    return TASK.problem(case, Seeds(0, TASK.name, 1, case.name, fold), open_archive())


def _errors(model_name, **parameters):
    """Return the RMS per frame of each row, averaged over the twelve windows."""
    rms, found = METRICS.get("rms_per_frame"), {}
    for row in ROWS:
        values = []
        for problem in (_problem(row, fold) for fold in range(N_WINDOWS)):
            model = problem.fit(build_model(model_name, parameters, 0))
            values.append(rms(problem.outcome(problem.solve(model, 0))).value)
        found[row] = float(np.mean(values))
    return found


def test_the_spline_equals_the_paper(num_regression):
    found = _errors("cubic-spline")
    published = published_values("missing-frames")
    for row, value in found.items():
        expected = published[row, "RMS per frame", "cubic-spline"].value
        assert abs(value - expected) <= 0.01, row
    num_regression.check(
        found,
        default_tolerance={"rtol": 1e-9, "atol": 0},
        fullpath=GOLDENS / "missing-frames-cubic-spline.csv",
    )


def test_aligned_windows_beat_the_spline_by_half(num_regression):
    found = _errors("aligned-window")
    assert abs(np.mean(list(found.values())) - 50.3) <= 1.0
    golden = GOLDENS / "missing-frames-aligned-window.csv"
    num_regression.check(found, default_tolerance={"rtol": 1e-9, "atol": 0}, fullpath=golden)


def test_a_constant_offset_takes_a_sixth_off_the_error_of_the_matched_frames():
    offset = np.mean(list(_errors("pose-viterbi").values()))
    none = np.mean(list(_errors("pose-viterbi", subject_offset=0.0).values()))
    assert abs(offset - 42.49) <= 0.01
    assert abs(none - 50.57) <= 0.01


def test_kriging_over_poses_takes_another_quarter_off():
    assert abs(np.mean(list(_errors("pose-kriging").values())) - 29.40) <= 0.01


@pytest.mark.slow
def test_a_balanced_model_is_no_worse_than_the_published_one():
    rms, problems = METRICS.get("rms_per_frame"), [_problem(row, 4) for row in ROWS]
    model = problems[0].fit(build_model("gpdm", {"start": "viterbi"}, 0))
    errors = [rms(each.outcome(each.solve(model, 0))).value for each in problems]
    assert np.mean(errors) <= 52.84
    assert 500 <= model.kernel_properties_["SNR(α)"] <= 1000


def test_the_windows_are_the_papers():
    archive, case = open_archive(), TASK.case("35-03 three-walkers")
    for fold in range(N_WINDOWS):
        problem = TASK.problem(case, Seeds(0, TASK.name, 1, case.name, fold), archive)
        hidden = ~problem.given[0].visible
        assert hidden.shape == (50, 50)
        assert (hidden.all(axis=1) == hidden.any(axis=1)).all()
        assert (np.flatnonzero(hidden[:, 0]) + 1).tolist() == list(range(5 + fold, 36 + fold))
        assert [len(walk.times) for walk in problem.train] == [71, 77, 71]
