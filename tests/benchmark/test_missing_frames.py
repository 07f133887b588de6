"""Missing frames against GPDM Table 2, on the recordings that are here."""

import os
from pathlib import Path

import numpy as np
import pytest

from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.seeds import Seeds
from mocapbench.benchmark.solving import build_model
from mocapbench.benchmark.tasks.missing_frames import N_WINDOWS
from mocapbench.datasets import open_archive
from mocapbench.reports.published import published_values

TASK = TASKS.get("missing-frames")
ROWS = ("35-03", "16-21", "07-01", "07-02", "08-01", "08-02")
GOLDENS = Path(__file__).parents[1] / "goldens"

pytestmark = [
    pytest.mark.recordings,
    pytest.mark.skipif(
        "MOCAPBENCH_DATA" not in os.environ, reason="MOCAPBENCH_DATA names no recordings"
    ),
]


def _errors(model_name, **parameters):
    """Return the RMS per frame of each row, averaged over the twelve windows."""
    archive, rms = open_archive(), METRICS.get("rms_per_frame")
    found = {}
    for row in ROWS:
        case, values = TASK.case(f"{row} three-walkers"), []
        for fold in range(N_WINDOWS):
            problem = TASK.problem(case, Seeds(0, TASK.name, 1, case.name, fold), archive)
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
    archive, rms = open_archive(), METRICS.get("rms_per_frame")
    model, values = build_model("gpdm", {"start": "viterbi"}, 0), []
    for row in ROWS:
        case = TASK.case(f"{row} three-walkers")
        for fold in range(0, N_WINDOWS, 4):
            problem = TASK.problem(case, Seeds(0, TASK.name, 1, case.name, fold), archive)
            if not values:
                problem.fit(model)
            values.append(rms(problem.outcome(problem.solve(model, 0))).value)
    assert np.mean(values) <= 52.84
    properties = model.kernel_properties_
    assert 500 <= properties["SNR(α)"] <= 1000
    assert 3 <= properties["SNR(β)"] <= 6


def test_the_windows_are_the_papers():
    archive, case = open_archive(), TASK.case("35-03 three-walkers")
    for fold in range(N_WINDOWS):
        problem = TASK.problem(case, Seeds(0, TASK.name, 1, case.name, fold), archive)
        hidden = ~problem.given[0].visible
        assert hidden.shape == (50, 50)
        assert (hidden.all(axis=1) == hidden.any(axis=1)).all()
        assert (np.flatnonzero(hidden[:, 0]) + 1).tolist() == list(range(5 + fold, 36 + fold))
        assert [len(walk.times) for walk in problem.train] == [71, 77, 71]
