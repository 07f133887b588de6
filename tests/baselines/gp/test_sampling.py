import numpy as np
import pytest

from mocapbench.baselines.gp.kernels import KERNELS
from mocapbench.baselines.gp.sampling import draw_layer


@pytest.mark.parametrize("name", KERNELS)
def test_draws_have_the_covariance_of_the_layer(name, case):
    parameters = case(np.random.default_rng(0), n_components=2, rank=2).parameters
    layer, times = parameters.layers["child"], np.array([0.0, 0.3, 1.1])
    n_samples = 40_000
    draws = draw_layer(KERNELS[name], layer, times, n_samples, np.random.default_rng(1))
    lags = np.subtract.outer(times, times)
    kernels = KERNELS[name].value(lags, layer.lengthscales[:, None, None])
    expected = np.einsum("qde,qst->sdte", layer.coregionalisation.matrices, kernels).reshape(6, 6)
    flat = draws.reshape(n_samples, 6)
    scale = np.sqrt(np.outer(expected.diagonal(), expected.diagonal()))
    # Five standard errors of a sample covariance, which are at most √(2 / n) of the scale.
    assert (np.abs(flat.T @ flat / n_samples - expected) < 5 * np.sqrt(2 / n_samples) * scale).all()
    assert (np.abs(flat.mean(axis=0)) < 5 * np.sqrt(expected.diagonal() / n_samples)).all()
