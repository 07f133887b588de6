"""Entries and new sequences have the moments that the model implies."""

import numpy as np

from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.state_space.kalman import smooth_states
from mocapbench.baselines.state_space.linear_gaussian import draw_sequences, entry_moments


def test_moments_of_entries_are_those_of_the_joint_gaussian(pose):
    problem = pose(1, n_channels=3)
    states = smooth_states(problem.parameters, problem.data)
    mean, variance = entry_moments(problem.parameters, states.mean, states.covariance)
    loadings = problem.parameters.loadings
    for k, exact in enumerate(problem.exact()):
        n = len(exact.mean)
        expected = exact.mean @ loadings.T + problem.parameters.offset
        np.testing.assert_allclose(mean[k, :n], expected, atol=1e-9)
        for t in range(n):
            signal = np.diag(loadings @ exact.covariance[t, :, t] @ loadings.T)
            np.testing.assert_allclose(variance[k, t], signal + problem.parameters.noise)


def test_draws_have_the_moments_of_a_sequence_without_visible_entries(pose):
    problem = pose(2, n_channels=2)
    hidden = Sequences.of([np.full((4, 2), np.nan)])
    states = smooth_states(problem.parameters, hidden)
    mean, variance = entry_moments(problem.parameters, states.mean, states.covariance)
    draws = draw_sequences(problem.parameters, 20_000, 4, np.random.default_rng(0))
    assert draws.shape == (20_000, 4, 2)
    error = (draws.mean(axis=0) - mean[0]) / np.sqrt(variance[0] / len(draws))
    assert np.abs(error).max() < 4.0
    np.testing.assert_allclose(draws.var(axis=0), variance[0], rtol=0.05)


def test_successive_draws_are_correlated_as_the_dynamics_say(pose):
    problem = pose(3, n_states=1, n_channels=1)
    draws = draw_sequences(problem.parameters, 20_000, 2, np.random.default_rng(0))[..., 0]
    parameters = problem.parameters
    lagged = parameters.transition[0, 0] * parameters.first_covariance[0, 0]
    expected = lagged * parameters.loadings[0, 0] ** 2
    spread = np.sqrt(draws[:, 0].var() * draws[:, 1].var() / len(draws))
    assert abs(np.cov(draws.T)[0, 1] - expected) < 5 * spread
