"""The Gaussian process against dense Gaussian algebra."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from mocapbench.baselines.gpdm.kernels import RBFKernel, ScaledKernel
from mocapbench.baselines.gpdm.regression import (
    condition_process,
    invert,
    log_start,
    negative_log_likelihood,
    signal_to_noise,
)

from .conftest import linear_rbf, numerical_gradient, relative_error

N, M, P = 7, 4, 3
KERNELS = {"rbf": ScaledKernel(RBFKernel()), "linear+rbf": linear_rbf(1)}


@pytest.fixture(params=KERNELS)
def problem(request):
    """Return a kernel, the log-parameters of its process, and inputs and targets, given and new."""
    rng, kernel = np.random.default_rng(0), KERNELS[request.param]
    start = log_start(kernel)
    theta = start + 0.2 * rng.standard_normal(len(start))
    return kernel, theta, rng.normal(size=(N + M, 2)), rng.normal(size=(N + M, P))


def covariance(kernel, theta, inputs):
    return kernel(theta[:-1], inputs, inputs)[0] + np.exp(-theta[-1]) * np.eye(len(inputs))


def conditional(kernel, theta, inputs, targets):
    """Return the moments of the last M targets given the first N, by the joint covariance."""
    joint = covariance(kernel, theta, inputs)
    gain = np.linalg.solve(joint[:N, :N], joint[:N, N:]).T
    return gain @ targets[:N], joint[N:, N:] - gain @ joint[:N, N:]


def test_the_likelihood_is_that_of_a_gaussian(problem):
    kernel, theta, inputs, targets = problem
    normal = multivariate_normal(np.zeros(N + M), covariance(kernel, theta, inputs))
    expected = -normal.logpdf(targets.T).sum() - 0.5 * P * (N + M) * np.log(2 * np.pi)
    value, _ = negative_log_likelihood(kernel, theta, inputs, targets)
    assert value == pytest.approx(expected, rel=1e-9)


def test_the_gradients_of_the_likelihood_are_finite_differences(problem):
    kernel, *arguments = problem
    _, (d_inputs, d_targets, d_theta) = negative_log_likelihood(kernel, *arguments)
    for index, gradient in enumerate((d_theta, d_inputs, d_targets)):

        def value(x, index=index):
            changed = [*arguments[:index], x, *arguments[index + 1 :]]
            return negative_log_likelihood(kernel, *changed)[0]

        assert relative_error(gradient, numerical_gradient(value, arguments[index])) < 1e-6


def test_moments_are_those_of_the_conditional(problem):
    kernel, theta, inputs, targets = problem
    conditioned = condition_process(kernel, theta, inputs[:N], targets[:N])
    mean, variance, _ = conditioned.moments(inputs[N:])
    expected_mean, expected_covariance = conditional(*problem)
    np.testing.assert_allclose(mean, expected_mean, atol=1e-9)
    np.testing.assert_allclose(variance, expected_covariance, atol=1e-9)
    means, variances = conditioned.marginals(inputs[N:])
    np.testing.assert_allclose(means, expected_mean, atol=1e-9)
    np.testing.assert_allclose(variances, np.diagonal(expected_covariance), atol=1e-9)


def test_visible_targets_are_copied_and_hidden_ones_conditioned_on_them(problem):
    kernel, theta, inputs, targets = problem
    visible = np.array([True, False, True, False])
    conditioned = condition_process(kernel, theta, inputs[:N], targets[:N])
    mean, variance = conditioned.fill_targets(inputs[N:], targets[N:], visible)
    np.testing.assert_allclose(mean[visible], targets[N:][visible], atol=1e-9)
    assert (variance[visible] == 0).all()
    given = np.concatenate([np.arange(N), N + np.flatnonzero(visible)])
    more = condition_process(kernel, theta, inputs[given], targets[given])
    means, variances = more.marginals(inputs[N:][~visible])
    np.testing.assert_allclose(mean[~visible], means, atol=1e-8)
    np.testing.assert_allclose(variance[~visible], variances, atol=1e-8)


def test_far_from_the_data_the_prior_remains():
    kernel = ScaledKernel(RBFKernel())
    theta = np.log([2.0, 1.0, 4.0])
    conditioned = condition_process(kernel, theta, np.zeros((1, 2)), np.ones((1, 1)))
    mean, variance = conditioned.marginals(np.full((1, 2), 50.0))
    assert mean.item() == pytest.approx(0.0)
    assert variance.item() == pytest.approx(2.0 + 0.25)


def test_the_signal_to_noise_ratio_is_that_of_standard_deviations():
    kernel = ScaledKernel(RBFKernel())
    assert signal_to_noise(kernel, np.log([4.0, 1.0, 9.0]), 2) == pytest.approx(6.0)


def test_an_inverse_inverts():
    factor = np.random.default_rng(0).normal(size=(6, 6))
    matrix = factor @ factor.T + np.eye(6)
    inverse, log_determinant = invert(matrix)
    np.testing.assert_allclose(inverse @ matrix, np.eye(6), atol=1e-10)
    assert log_determinant == pytest.approx(np.linalg.slogdet(matrix)[1])
    assert invert(np.empty((0, 0)))[1] == 0.0


def test_what_no_jitter_makes_positive_definite_is_refused():
    with pytest.raises(np.linalg.LinAlgError, match="positive definite"):
        invert(-np.eye(3))
    inverse, log_determinant = invert(np.ones((3, 3)))
    assert np.isfinite(inverse).all()
    assert np.isfinite(log_determinant)
