import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sklearn.gaussian_process.kernels import RBF, Matern

from mocapbench.baselines.gp.prior.kernels import KERNELS

PEERS = {
    "rbf": RBF,
    "matern12": lambda scale: Matern(scale, nu=0.5),
    "matern32": lambda scale: Matern(scale, nu=1.5),
    "matern52": lambda scale: Matern(scale, nu=2.5),
}
TIMES = np.sort(np.random.default_rng(0).uniform(0.0, 3.0, 12))
LAGS = np.subtract.outer(TIMES, TIMES)
lengthscales = st.floats(0.05, 20.0)


@pytest.mark.parametrize("name", KERNELS)
@given(scale=lengthscales)
def test_value_agrees_with_scikit_learn(name, scale):
    expected = PEERS[name](scale)(TIMES[:, None])
    np.testing.assert_allclose(KERNELS[name].value(LAGS, scale), expected, rtol=1e-10, atol=1e-14)


@pytest.mark.parametrize("name", KERNELS)
@given(scale=lengthscales)
def test_gradient_is_the_derivative_in_the_log_lengthscale(name, scale):
    kernel, step = KERNELS[name], 1e-5
    up, down = (kernel.value(LAGS, scale * np.exp(s)) for s in (step, -step))
    np.testing.assert_allclose(kernel.gradient(LAGS, scale), (up - down) / (2 * step), atol=1e-8)


@pytest.mark.parametrize("name", KERNELS)
def test_lengthscales_broadcast(name):
    scales = np.array([0.3, 1.0, 4.0])
    stacked = KERNELS[name].value(LAGS, scales[:, None, None])
    for gram, scale in zip(stacked, scales, strict=True):
        np.testing.assert_array_equal(gram, KERNELS[name].value(LAGS, scale))


@pytest.mark.parametrize("name", KERNELS)
@given(scale=lengthscales)
def test_gram_matrices_have_unit_variance_and_are_positive_semi_definite(name, scale):
    gram = KERNELS[name].value(LAGS, scale)
    np.testing.assert_array_equal(np.diagonal(gram), 1.0)
    assert np.linalg.eigvalsh(gram).min() > -1e-12
