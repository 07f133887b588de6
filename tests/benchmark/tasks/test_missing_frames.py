"""Missing frames against GPDM Table 2, on the recordings that are here."""

import os
from pathlib import Path

import numpy as np
import pytest

from mocapbench.baselines import GPDM
from mocapbench.benchmark import METRICS, MODELS
from mocapbench.benchmark.tasks.missing_frames import N_WINDOWS
from mocapbench.reports.paper.published import published_values

ROWS = ("35-03", "16-21", "07-01", "07-02", "08-01", "08-02")
GOLDENS = Path(__file__).parents[2] / "goldens"

pytestmark = [
    pytest.mark.recordings,
    pytest.mark.skipif(
        "MOCAPBENCH_DATA" not in os.environ, reason="MOCAPBENCH_DATA names no recordings"
    ),
]


@pytest.fixture(scope="module")
def windows(posed):
    """Return the problems of each row without the training walker that is not here."""
    return {
        row: [posed("missing-frames", f"{row} three-walkers", fold) for fold in range(N_WINDOWS)]
        for row in ROWS
    }


def _errors(windows, name, **parameters):
    """Return the RMS per frame of each row, averaged over the twelve windows."""
    rms, errors = METRICS.get("rms_per_frame"), {}
    for row, problems in windows.items():
        values = []
        for problem in problems:
            model = problem.fit(MODELS.get(name)(**parameters))
            values.append(rms(problem.outcome(problem.solve(model, 0))).value)
        errors[row] = float(np.mean(values))
    return errors


@pytest.mark.slow
def test_the_spline_equals_the_paper(windows, num_regression):
    errors = _errors(windows, "cubic-spline")
    published = published_values("missing-frames")
    for row, value in errors.items():
        expected = published[row, "RMS per frame", "cubic-spline"].value
        assert abs(value - expected) <= 0.01, row
    num_regression.check(
        errors,
        default_tolerance={"rtol": 1e-9, "atol": 0},
        fullpath=GOLDENS / "missing-frames-cubic-spline.csv",
    )


def test_aligned_windows_beat_the_spline_by_half(windows, num_regression):
    errors = _errors(windows, "aligned-window")
    assert abs(np.mean(list(errors.values())) - 50.3) <= 1.0
    golden = GOLDENS / "missing-frames-aligned-window.csv"
    num_regression.check(errors, default_tolerance={"rtol": 1e-9, "atol": 0}, fullpath=golden)


def test_a_constant_offset_takes_a_sixth_off_the_error_of_the_matched_frames(windows):
    offset = np.mean(list(_errors(windows, "pose-viterbi").values()))
    none = np.mean(list(_errors(windows, "pose-viterbi", subject_offset=0.0).values()))
    assert abs(offset - 42.49) <= 0.01
    assert abs(none - 50.57) <= 0.01


@pytest.mark.slow
def test_kriging_over_poses_and_their_mirror_images_nearly_halves_that(windows):
    assert abs(np.mean(list(_errors(windows, "pose-kriging").values())) - 21.86) <= 0.01


@pytest.mark.slow
def test_a_balanced_model_is_no_worse_than_the_published_one(windows):
    rms, problems = METRICS.get("rms_per_frame"), [windows[row][4] for row in ROWS]
    model = problems[0].fit(GPDM(start="viterbi", random_state=0))
    errors = [rms(each.outcome(each.solve(model, 0))).value for each in problems]
    assert np.mean(errors) <= 52.84
    assert 500 <= model.kernel_properties_["SNR(α)"] <= 1000


def test_the_windows_are_the_papers(windows):
    for fold, problem in enumerate(windows["35-03"]):
        hidden = ~problem.given[0].visible
        assert hidden.shape == (50, 50)
        assert (hidden.all(axis=1) == hidden.any(axis=1)).all()
        assert (np.flatnonzero(hidden[:, 0]) + 1).tolist() == list(range(5 + fold, 36 + fold))
        assert [len(walk.times) for walk in problem.train] == [71, 77, 71]
