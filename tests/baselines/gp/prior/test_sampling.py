from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines.gp.prior.kernels import KERNELS


@pytest.mark.parametrize("name", KERNELS)
@pytest.mark.parametrize("rank", [0, 2])
def test_draws_have_the_covariance_of_the_layer(name, rank, case):
    parameters = case(np.random.default_rng(0), n_components=2, rank=rank).parameters
    layer, times = parameters.layers["child"], np.array([0.0, 0.3, 1.1])
    n_samples = 40_000
    draws = layer.draw(KERNELS[name], times, n_samples, np.random.default_rng(1))
    lags = np.subtract.outer(times, times)
    kernels = KERNELS[name].value(lags, layer.lengthscales[:, None, None])
    expected = np.einsum("qde,qst->sdte", layer.matrices, kernels).reshape(6, 6)
    flat = draws.reshape(n_samples, 6)
    scale = np.sqrt(np.outer(expected.diagonal(), expected.diagonal()))
    # Five standard errors of a sample covariance, which are at most √(2 / n) of the scale.
    assert (np.abs(flat.T @ flat / n_samples - expected) < 5 * np.sqrt(2 / n_samples) * scale).all()
    assert (np.abs(flat.mean(axis=0)) < 5 * np.sqrt(expected.diagonal() / n_samples)).all()


def test_draws_depend_only_on_the_seed_and_are_functions_of_time(case):
    parameters = case(np.random.default_rng(0), n_components=2, rank=0).parameters
    for kernel in KERNELS.values():
        first, again = (
            parameters.layers["child"].draw(
                kernel, np.array([0.4, 2.0, 0.4]), 5, np.random.default_rng(3)
            )
            for _ in range(2)
        )
        np.testing.assert_array_equal(first, again)
        np.testing.assert_allclose(first[:, 0], first[:, 2], atol=1e-12)
        assert (first[:, 0] != first[:, 1]).all()


@pytest.mark.parametrize("name", KERNELS)
def test_rounding_changes_draws_by_little(name, case):
    parameters = case(np.random.default_rng(0), n_components=2, rank=1).parameters
    layer, times = parameters.layers["child"], np.linspace(0.0, 2 * np.pi, 30)
    rounded = replace(
        layer,
        log_lengthscales=layer.log_lengthscales + 1e-15 * np.array([1.0, -1.0]),
        kappa_roots=-layer.kappa_roots,
    )
    first, again = (
        one.draw(KERNELS[name], times, 5, np.random.default_rng(3)) for one in (layer, rounded)
    )
    np.testing.assert_allclose(first, again, atol=1e-6 * np.abs(first).max())
