import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import multivariate_normal

from mocapbench.baselines.functional.components import (
    LEAST_NOISE,
    find_principal_axes,
    infer_scores,
    penalised_likelihood,
    update_components,
)
from mocapbench.baselines.functional.fourier_series import fourier, norms


def _components(seed, n_components=2, n_channels=3, n_harmonics=2):
    rng = np.random.default_rng(seed)
    shape = (n_components + 1, n_channels, 2 * n_harmonics + 1)
    return rng.normal(size=shape), rng.uniform(0.1, 1.0, n_channels)


def _visible(pair, coefficients, noise):
    """Return the visible entries, their mean, the loadings of scores and their noise."""
    phases, values = pair
    functions = np.einsum("np,adp->nda", fourier(phases, 2), coefficients)
    seen = ~np.isnan(values)
    noise = np.broadcast_to(noise, values.shape)[seen]
    return values[seen], functions[seen][:, 0], functions[seen][:, 1:], noise


@pytest.mark.parametrize("n_components", [0, 1, 3])
def test_scores_and_likelihood_are_those_of_the_joint_gaussian(curves, n_components):
    given_curves, components = curves(4), _components(5, n_components)
    scores = infer_scores(given_curves.statistics, *components)
    for j, pair in enumerate(given_curves.pairs):
        x, mean, loadings, noise = _visible(pair, *components)
        covariance = loadings @ loadings.T + np.diag(noise)
        gain = np.linalg.solve(covariance, loadings).T
        np.testing.assert_allclose(scores.mean[j], gain @ (x - mean), atol=1e-8)
        np.testing.assert_allclose(
            scores.covariance[j], np.eye(n_components) - gain @ loadings, atol=1e-8
        )
        expected = multivariate_normal(mean, covariance).logpdf(x) if len(x) else 0.0
        assert scores.log_likelihood[j] == pytest.approx(expected)


@settings(max_examples=40, deadline=None)
@given(
    seed=st.integers(0, 10**6),
    n_components=st.integers(0, 3),
    smoothness=st.sampled_from([1e-4, 0.1, 10.0]),
    hidden=st.sampled_from([0.0, 0.3, 0.8]),
)
def test_an_update_never_lowers_the_penalised_likelihood(
    curves, seed, n_components, smoothness, hidden
):
    statistics = curves(seed, hidden=hidden).statistics
    components, before = _components(seed, n_components), -np.inf
    for _ in range(6):
        fit = infer_scores(statistics, *components)
        value = penalised_likelihood(fit, smoothness)
        assert value >= before - 1e-8 * (1.0 + abs(value))
        components, before = update_components(statistics, fit, smoothness), value


def test_without_components_the_update_is_the_regression_of_the_mean(curves):
    given_curves, components = curves(6), _components(7, 0)
    fit = infer_scores(given_curves.statistics, *components)
    coefficients, noise = update_components(given_curves.statistics, fit, 1e-9)
    for d in range(3):
        pairs = [(phases, values[:, d]) for phases, values in given_curves.pairs]
        phases, values = (np.concatenate(part) for part in zip(*pairs, strict=True))
        seen = ~np.isnan(values)
        basis = fourier(phases[seen], 2)
        expected, *_ = np.linalg.lstsq(basis, values[seen], rcond=None)
        np.testing.assert_allclose(coefficients[0, d], expected, rtol=1e-5, atol=1e-5)
        residual = ((values[seen] - basis @ expected) ** 2).mean()
        assert noise[d] == pytest.approx(max(residual, LEAST_NOISE), rel=1e-5)


def test_principal_axes_are_orthogonal_and_the_same_model(curves):
    statistics, (coefficients, noise) = curves(8).statistics, _components(9, 3)
    rotated = find_principal_axes(coefficients)
    functions = (rotated[1:] * np.sqrt(norms(2))).reshape(3, -1)
    gram = functions @ functions.T
    np.testing.assert_allclose(gram, np.diag(np.diag(gram)), atol=1e-10)
    assert (np.diff(np.diag(gram)) < 0).all()
    one, two = (infer_scores(statistics, c, noise).log_likelihood for c in (coefficients, rotated))
    np.testing.assert_allclose(one, two)
