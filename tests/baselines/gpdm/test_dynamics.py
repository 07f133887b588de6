"""Priors of trajectories: Markov dynamics and independent positions."""

import numpy as np
import pytest

from mocapbench.baselines.gpdm.dynamics import Markov, Static
from mocapbench.baselines.gpdm.kernels import LinearKernel

from .conftest import DYNAMICS, LENGTHS, numerical_gradient, relative_error


@pytest.fixture
def positions():
    return np.random.default_rng(0).standard_normal((sum(LENGTHS), 2))


def test_the_gradient_of_the_prior_is_finite_differences(dynamics, positions):
    theta = dynamics.start
    _, d_x, d_theta = dynamics.negative_log_prior(theta, positions, LENGTHS)
    by_x = numerical_gradient(
        lambda x: dynamics.negative_log_prior(theta, x, LENGTHS)[0], positions
    )
    by_theta = numerical_gradient(
        lambda t: dynamics.negative_log_prior(t, positions, LENGTHS)[0], theta
    )
    assert relative_error(d_x, by_x) < 1e-6
    assert relative_error(d_theta, by_theta) < 1e-6


def test_the_order_of_sequences_does_not_matter(dynamics, positions):
    first, second = positions[: LENGTHS[0]], positions[LENGTHS[0] :]
    swapped = np.concatenate([second, first])
    value = dynamics.negative_log_prior(dynamics.start, positions, LENGTHS)[0]
    other = dynamics.negative_log_prior(dynamics.start, swapped, LENGTHS[::-1])[0]
    assert value == pytest.approx(other, rel=1e-9)


def test_a_new_trajectory_has_the_quotient_of_two_priors(dynamics, positions):
    new = np.random.default_rng(1).standard_normal((5, 2))
    theta, both = dynamics.start, np.concatenate([positions, new])
    conditional = dynamics.condition(theta, positions, LENGTHS).negative_log_density(new)[0]
    joint = dynamics.negative_log_prior(theta, both, (*LENGTHS, 5))[0]
    marginal = dynamics.negative_log_prior(theta, positions, LENGTHS)[0]
    assert conditional == pytest.approx(joint - marginal, rel=1e-7)


@pytest.mark.parametrize("name", [name for name in DYNAMICS if name != "static"])
def test_a_step_is_the_conditional_mean_of_the_next_position(name, positions):
    """The log-density is quadratic in the last position: its gradient is zero at the mean."""
    dynamics = DYNAMICS[name]
    conditioned = dynamics.condition(dynamics.start, positions, LENGTHS)
    history = np.random.default_rng(2).standard_normal((1, dynamics.order, 2))
    mean, variance = conditioned.step(history)
    trajectory = np.concatenate([history[0, ::-1], mean])
    _, gradient = conditioned.negative_log_density(trajectory)
    np.testing.assert_allclose(gradient[-1], 0.0, atol=1e-8)
    moved = trajectory.copy()
    moved[-1, 0] += 1.0
    _, gradient = conditioned.negative_log_density(moved)
    assert gradient[-1, 0] == pytest.approx(1 / variance[0], rel=1e-6)


def test_without_dynamics_positions_are_standard_normal(positions):
    static = Static()
    assert static.negative_log_density(positions)[0] == pytest.approx(0.5 * (positions**2).sum())
    mean, variance = static.step(np.ones((3, 1, 2)))
    np.testing.assert_array_equal(mean, np.zeros((3, 2)))
    np.testing.assert_array_equal(variance, np.ones(3))
    assert static.properties(static.start, 2) == {}


def test_without_information_a_position_returns_to_zero_and_a_velocity_continues():
    kernel, history = LinearKernel(), np.full((1, 1, 1), 3.0)
    for carry, expected in ((0.0, 0.0), (1.0, 3.0)):
        dynamics = Markov(kernel, carry=carry)
        conditioned = dynamics.condition(dynamics.start, np.zeros((6, 1)), (6,))
        assert conditioned.step(history)[0].item() == pytest.approx(expected)
