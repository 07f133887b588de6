"""New cycles and sequences from a fitted model."""

import numpy as np
import pytest

from mocapbench.baselines.alignment.new_motion import (
    blend_cycles,
    draw_cycles,
    draw_path,
    draw_sequences,
)
from mocapbench.baselines.alignment.updates import update_cycles


@pytest.fixture
def state(pose):
    posed = pose(1, n_styles=2, n_states=7)
    return update_cycles(posed.state, posed.sequences, posed.hyper)


def test_a_path_goes_round_by_jumps_of_their_probabilities():
    jumps, rng = np.array([0.2, 0.0, 0.8]), np.random.default_rng(0)
    path = draw_path(jumps, 8, 5000, rng)
    steps = np.bincount(np.diff(path) % 8, minlength=4)[1:] / 4999
    np.testing.assert_allclose(steps, jumps, atol=0.03)
    assert ((path >= 0) & (path < 8)).all()


def test_drawn_cycles_have_the_moments_of_their_posterior(state):
    draws = draw_cycles(state, 1, 4000, np.random.default_rng(0))
    mean, variance = state.cycles.mean[:, 1], state.cycles.variance[:, 1]
    assert draws.shape == (4000, 7, 3)
    errors = (draws.mean(axis=0) - mean) / np.sqrt(variance / 4000)
    assert np.abs(errors).max() < 5.0
    np.testing.assert_allclose(draws.var(axis=0), variance, rtol=0.15)
    following = np.roll(draws, -1, axis=1)
    products = (draws - mean) * (following - np.roll(mean, -1, axis=0))
    scale = np.sqrt(variance * np.roll(variance, -1, axis=0))
    np.testing.assert_allclose(
        products.mean(axis=0) / scale, state.cycles.neighbour[:, 1] / scale, atol=0.1
    )


def test_sequences_are_seeded_and_of_any_length(state):
    for n_frames in (1, 12):
        first, again = (draw_sequences(state, 3, n_frames, np.random.default_rng(0)) for _ in "ab")
        assert first.shape == (3, n_frames, 3)
        np.testing.assert_array_equal(first, again)


def test_a_blend_of_one_style_runs_through_its_cycle(state):
    jumps = state.jumps.mean(axis=0)
    pace = jumps @ np.arange(1, len(jumps) + 1)
    motion = blend_cycles(state, np.tile([1.0, 0.0], (9, 1)))
    closed = np.concatenate([state.cycles.mean[:, 0], state.cycles.mean[:1, 0]])
    for channel, curve in zip(motion.T, closed.T, strict=True):
        np.testing.assert_allclose(channel, np.interp(pace * np.arange(9) % 7, range(8), curve))


def test_a_blend_is_linear_in_the_weights(state):
    weights = np.random.default_rng(0).dirichlet([1, 1], 5)
    ends = [blend_cycles(state, np.tile(row, (5, 1))) for row in np.eye(2)]
    expected = weights[:, :1] * ends[0] + weights[:, 1:] * ends[1]
    np.testing.assert_allclose(blend_cycles(state, weights), expected)


@pytest.mark.parametrize(
    ("weights", "message"),
    [
        (np.ones((3, 3)) / 3, "expected weights of shape"),
        (np.ones(2) / 2, "expected weights of shape"),
        (np.ones((3, 2)), "rows sum to 1"),
        (np.array([[1.5, -0.5]]), "non-negative"),
    ],
)
def test_weights_are_checked(state, weights, message):
    with pytest.raises(ValueError, match=message):
        blend_cycles(state, weights)
