import numpy as np
import pytest

from mocapbench.baselines import Prediction
from mocapbench.benchmark import (
    ImputeProblem,
    Solved,
    draw_gap_error,
    hide_all_but,
    hide_frames,
)
from mocapbench.datasets import Recording

RNG = np.random.default_rng(0)
WALK = Recording("walk", np.arange(9.0), RNG.normal(size=(9, 2)), ("a", "b"), ("deg", "deg"))


def _solved(mask):
    """Return the walk with ``mask``, filled by seven entrants with errors of different sizes."""
    problem = ImputeProblem.of_one(WALK, mask)
    solutions = {
        f"off by {size}": (Prediction(WALK.values + size * RNG.uniform(0.9, 1.1, size=(9, 2))),)
        for size in (4, 7, 1, 5, 2, 6, 3)
    }
    return Solved("missing-frames", problem, solutions)


@pytest.fixture(scope="module")
def solved():
    return _solved(hide_frames(2, 6, 9, 2))


def test_the_error_along_the_gap_is_that_of_hidden_frames(solved):
    (illustration,) = draw_gap_error(solved)
    hidden = np.flatnonzero(~solved.problem.given[0].visible[:, 0])
    for curve in illustration.axes[0].curves:
        error = solved.solutions[curve.group][0].mean - solved.problem.truth[0]
        np.testing.assert_array_equal(curve.x, hidden + 1)
        np.testing.assert_allclose(curve.y, np.linalg.norm(error[hidden], axis=1))


@pytest.mark.parametrize("n_best", [1, 5, 9])
def test_the_best_are_shown_the_very_best_first(solved, n_best):
    (illustration,) = draw_gap_error(solved, n_best)
    expected = [f"off by {size}" for size in range(1, 8)][:n_best]
    assert list(illustration.groups) == expected
    assert f"the {len(expected)} entrants" in illustration.caption


def test_there_is_no_gap_where_no_frame_is_hidden_as_a_whole():
    scattered = hide_all_but(np.random.default_rng(1), 5, 9, 2)
    scattered[:, 1] &= ~scattered[:, 0]
    assert draw_gap_error(_solved(scattered)) == ()
