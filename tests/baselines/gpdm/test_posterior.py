"""The objectives against finite differences, dense references and each other."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from mocapbench.baselines.gpdm.conditional import Conditional
from mocapbench.baselines.gpdm.posterior import KAPPA

from .conftest import (
    DYNAMICS,
    LENGTHS,
    numerical_gradient,
    random_estimate,
    random_posterior,
    relative_error,
)


def test_the_gradients_of_the_posterior_are_finite_differences(dynamics):
    rng = np.random.default_rng(0)
    posterior, at = random_posterior(rng, dynamics), random_estimate(rng, dynamics, sum(LENGTHS))
    _, gradients = posterior.value_and_gradients(at)
    for name, gradient in zip(("x", "alpha", "beta"), gradients, strict=True):
        expected = numerical_gradient(
            lambda v, name=name: posterior.value_and_gradients(replace(at, **{name: v}))[0],
            getattr(at, name),
        )
        assert relative_error(gradient, expected) < 1e-6, name


@pytest.mark.parametrize("n_visible", [0, 3, 6])
def test_the_gradient_of_the_conditional_is_finite_differences(dynamics, n_visible):
    rng = np.random.default_rng(1)
    posterior, at = random_posterior(rng, dynamics), random_estimate(rng, dynamics, sum(LENGTHS))
    model = Conditional.of(posterior, at)
    query = (rng.standard_normal((6, 4)), np.arange(6) < n_visible)
    x = rng.standard_normal((6, 2))
    expected = numerical_gradient(lambda v: model.negative_log_density(v, query)[0], x)
    assert relative_error(model.negative_log_density(x, query)[1], expected) < 1e-6


def test_the_conditional_of_visible_frames_is_a_quotient_of_joints(dynamics):
    rng = np.random.default_rng(2)
    posterior, at = random_posterior(rng, dynamics), random_estimate(rng, dynamics, sum(LENGTHS))
    y, x = rng.standard_normal((6, 4)), rng.standard_normal((6, 2))
    both = replace(posterior, y=np.concatenate([posterior.y, y]), lengths=(*LENGTHS, 6))
    joint = both.value_and_gradients(replace(at, x=np.concatenate([at.x, x])))[0]
    query = (y * at.scales, np.ones(6, dtype=bool))
    conditional = Conditional.of(posterior, at).negative_log_density(x, query)[0]
    np.testing.assert_allclose(conditional, joint - posterior.value_and_gradients(at)[0], rtol=1e-8)


def test_hidden_frames_at_their_mean_cost_what_the_visible_ones_do():
    rng, dynamics = np.random.default_rng(3), DYNAMICS["linear+rbf"]
    posterior, at = random_posterior(rng, dynamics), random_estimate(rng, dynamics, sum(LENGTHS))
    process = Conditional.of(posterior, at).reconstruction
    x, y, visible = rng.standard_normal((6, 2)), rng.standard_normal((6, 4)), np.arange(6) % 2 == 0
    filled, _ = process.fill_targets(x, y, visible)
    everything = process.negative_log_density(x, filled, np.ones(6, dtype=bool))[0]
    np.testing.assert_allclose(process.negative_log_density(x, y, visible)[0], everything)


def test_the_posterior_is_the_sum_of_normal_densities():
    rng, dynamics = np.random.default_rng(4), DYNAMICS["linear+rbf"]
    posterior, at = random_posterior(rng, dynamics), random_estimate(rng, dynamics, sum(LENGTHS))
    a1, a2, a3, a4 = np.exp(at.alpha)
    b1, b2 = np.exp(at.beta)
    distance = ((at.x[:, None] - at.x) ** 2).sum(axis=2)
    poses = np.exp(-0.5 * b1 * distance) + np.eye(12) / b2
    before, after = np.delete(np.arange(12), [6, 11]), np.delete(np.arange(12), [0, 7])
    steps = a1 * np.exp(-0.5 * a2 * distance) + a3 * at.x @ at.x.T
    steps = steps[np.ix_(before, before)] + np.eye(10) / a4
    densities = (
        (poses, posterior.y * at.scales, 1.0),
        (steps, at.x[after], 1.7),
        (np.eye(2), at.x[[0, 7]], 1.7),
    )
    expected = at.alpha.sum() + at.beta.sum()
    for covariance, columns, weight in densities:
        normal = multivariate_normal(cov=covariance)
        constant = 0.5 * len(covariance) * np.log(2 * np.pi)
        expected -= weight * sum(normal.logpdf(column) + constant for column in columns.T)
    np.testing.assert_allclose(posterior.value_and_gradients(at)[0], expected, rtol=1e-10)


def test_the_best_scales_have_no_gradient():
    rng, dynamics = np.random.default_rng(5), DYNAMICS["linear+rbf"]
    posterior, at = random_posterior(rng, dynamics), random_estimate(rng, dynamics, sum(LENGTHS))
    best = posterior.best_scales(posterior.inverse(at.x, at.beta))

    def objective(scales):
        regular = 0.5 * (scales**2).sum() / KAPPA**2 - len(posterior.y) * np.log(scales).sum()
        return posterior.value_and_gradients(replace(at, scales=scales))[0] + regular

    np.testing.assert_allclose(numerical_gradient(objective, best), 0.0, atol=1e-6)
