"""Initial trajectories of a sequence to fill."""

import numpy as np
import pytest

from mocapbench.baselines.gpdm.rollout import roll_out
from mocapbench.baselines.gpdm.starts import STARTS, linear, mean_prediction, viterbi, window

FIRST = slice(0, 7)
"""The frames of the first training sequence."""


@pytest.fixture(params=["inner gap", "first frames", "last frames"])
def query(request, conditional):
    """Return the first training sequence with some frames hidden."""
    hidden = {"inner gap": [3, 4], "first frames": [0, 1], "last frames": [5, 6]}[request.param]
    return (conditional.poses[FIRST], ~np.isin(np.arange(7), hidden))


@pytest.mark.parametrize("start", STARTS)
def test_a_start_is_a_finite_trajectory(conditional, query, start):
    x = STARTS[start](conditional, query)
    assert x.shape == (7, 2)
    assert np.isfinite(x).all()


@pytest.mark.parametrize("start", ["linear", "mean-prediction"])
def test_visible_frames_lie_at_the_nearest_training_frame(conditional, query, start):
    x = STARTS[start](conditional, query)
    np.testing.assert_allclose(x[query[1]], conditional.x[FIRST][query[1]])


def test_a_line_joins_the_ends_of_a_gap_and_holds_beyond_them(conditional):
    visible = ~np.isin(np.arange(7), [0, 3, 4, 6])
    x = linear(conditional, (conditional.poses[FIRST], visible))
    np.testing.assert_allclose(np.diff(x[2:6], n=2, axis=0), 0.0, atol=1e-12)
    np.testing.assert_allclose(x[[0, 6]], x[[1, 5]])


def test_hidden_poses_are_not_read(conditional, query):
    poses = query[0].copy()
    poses[~query[1]] = 1e3
    for start in STARTS.values():
        changed = start(conditional, (poses, query[1]))
        np.testing.assert_allclose(changed, start(conditional, query))


def test_a_gap_is_filled_by_the_conditional_mean(conditional):
    query = (conditional.poses[FIRST], np.arange(7) != 4)
    x = mean_prediction(conditional, query)
    np.testing.assert_allclose(x, roll_out(conditional.dynamics, x, np.array([4])))


def test_a_training_sequence_is_its_own_window_and_path(conditional, query):
    np.testing.assert_allclose(window(conditional, query), conditional.x[FIRST])
    complete = (query[0], np.ones(7, dtype=bool))
    np.testing.assert_allclose(viterbi(conditional, complete), conditional.x[FIRST])


def test_a_path_is_made_of_training_positions(conditional, query):
    path = viterbi(conditional, query)
    distances = np.linalg.norm(path[:, None] - conditional.x, axis=2)
    np.testing.assert_allclose(distances.min(axis=1), 0.0, atol=1e-12)
