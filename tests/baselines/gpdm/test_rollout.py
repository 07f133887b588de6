"""New trajectories: the dynamics' conditional mean, and draws around it."""

import numpy as np
import pytest

from mocapbench.baselines.gpdm.dynamics import Static
from mocapbench.baselines.gpdm.hmc import HybridMonteCarlo
from mocapbench.baselines.gpdm.rollout import fair_trajectories, mean_trajectory, roll_out

SAMPLER = HybridMonteCarlo(n_samples=5, n_burn=5, n_leaps=5, step=0.05)


def test_the_mean_trajectory_follows_the_conditional_mean(conditional):
    dynamics, first = conditional.dynamics, conditional.x[:2]
    x = mean_trajectory(dynamics, first, 6)
    np.testing.assert_array_equal(x[:2], first)
    for frame in range(2, 6):
        history = x[[frame - 1, frame - 2]][None]
        np.testing.assert_allclose(x[frame], dynamics.step(history)[0][0])


def test_a_trajectory_may_be_shorter_than_its_first_positions(conditional):
    x = mean_trajectory(conditional.dynamics, conditional.x[:2], 1)
    np.testing.assert_array_equal(x, conditional.x[:1])


def test_only_the_frames_named_are_replaced(conditional):
    x = conditional.x[:6]
    rolled = roll_out(conditional.dynamics, x, np.array([3, 4]))
    kept = [0, 1, 2, 5]
    np.testing.assert_array_equal(rolled[kept], x[kept])
    expected = conditional.dynamics.step(rolled[[3, 2]][None])[0][0]
    np.testing.assert_allclose(rolled[4], expected)


def test_before_the_first_position_it_is_repeated(conditional):
    rolled = roll_out(conditional.dynamics, conditional.x[:3], np.array([1]))
    history = conditional.x[[0, 0]][None]
    np.testing.assert_allclose(rolled[1], conditional.dynamics.step(history)[0][0])


@pytest.mark.parametrize("n_frames", [1, 2, 6])
def test_draws_keep_the_first_positions(conditional, n_frames):
    first, rng = conditional.x[:2], np.random.default_rng(0)
    drawn = fair_trajectories(conditional.dynamics, first, n_frames, SAMPLER, rng)
    assert drawn.shape == (5, n_frames, 2)
    np.testing.assert_array_equal(drawn[:, :2], np.broadcast_to(first, (5, 2, 2))[:, :n_frames])


def test_draws_are_seeded(conditional):
    def draw(seed):
        rng = np.random.default_rng(seed)
        return fair_trajectories(conditional.dynamics, conditional.x[:2], 6, SAMPLER, rng)

    np.testing.assert_array_equal(draw(1), draw(1))
    assert not np.array_equal(draw(1), draw(2))


def test_draws_have_the_moments_of_a_known_prior():
    sampler = HybridMonteCarlo(n_samples=1000, n_burn=0, n_leaps=8, step=0.2)
    drawn = fair_trajectories(Static(), np.zeros((1, 2)), 4, sampler, np.random.default_rng(0))
    later = drawn[:, 1:].reshape(-1, 2)
    np.testing.assert_allclose(later.mean(axis=0), 0.0, atol=0.1)
    np.testing.assert_allclose(np.cov(later.T), np.eye(2), atol=0.15)
