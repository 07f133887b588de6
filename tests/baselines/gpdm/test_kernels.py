"""Covariance functions: symmetric, positive semi-definite, and differentiated correctly."""

import numpy as np
import pytest

from mocapbench.baselines.gpdm.kernels import LinearKernel, RBFKernel, ScaledKernel, SumKernel

from .conftest import linear_rbf, numerical_gradient, relative_error

N_COLUMNS = 4
KERNELS = {
    "rbf": RBFKernel(),
    "rbf of two lags": RBFKernel(2),
    "linear": LinearKernel(),
    "linear of two lags": LinearKernel(2),
    "scaled": ScaledKernel(RBFKernel(2)),
    "sum": SumKernel(LinearKernel(), RBFKernel()),
    "linear+rbf": linear_rbf(1),
    "linear+rbf of two lags": linear_rbf(2),
}


@pytest.fixture(params=KERNELS)
def kernel(request):
    return KERNELS[request.param]


@pytest.fixture
def rng():
    return np.random.default_rng(0)


def parameters(kernel, rng):
    return np.log(kernel.start) + 0.3 * rng.standard_normal(len(kernel.start))


def test_a_gram_matrix_is_symmetric_and_positive_semi_definite(kernel, rng):
    theta, a = parameters(kernel, rng), rng.standard_normal((9, N_COLUMNS))
    gram, _ = kernel(theta, a, a)
    np.testing.assert_allclose(gram, gram.T, atol=1e-12)
    assert np.linalg.eigvalsh(gram).min() > -1e-10


def test_the_diagonal_is_that_of_the_gram_matrix(kernel, rng):
    theta, a = parameters(kernel, rng), rng.standard_normal((9, N_COLUMNS))
    np.testing.assert_allclose(kernel.diagonal(theta, a), np.diagonal(kernel(theta, a, a)[0]))


def test_swapping_the_inputs_transposes_the_matrix(kernel, rng):
    theta = parameters(kernel, rng)
    a, b = rng.standard_normal((3, N_COLUMNS)), rng.standard_normal((5, N_COLUMNS))
    np.testing.assert_allclose(kernel(theta, a, b)[0], kernel(theta, b, a)[0].T)


def test_the_pullback_is_finite_differences(kernel, rng):
    theta, weights = parameters(kernel, rng), rng.standard_normal((3, 5))
    a, b = rng.standard_normal((3, N_COLUMNS)), rng.standard_normal((5, N_COLUMNS))
    d_a, d_b, d_theta = kernel(theta, a, b)[1](weights)
    for gradient, function, at in (
        (d_a, lambda x: (weights * kernel(theta, x, b)[0]).sum(), a),
        (d_b, lambda x: (weights * kernel(theta, a, x)[0]).sum(), b),
        (d_theta, lambda x: (weights * kernel(x, a, b)[0]).sum(), theta),
    ):
        assert relative_error(gradient, numerical_gradient(function, at)) < 1e-7


def test_the_closed_forms():
    a, b = np.array([[1.0, 2.0]]), np.array([[3.0, -1.0]])
    assert RBFKernel()(np.log([0.5]), a, b)[0].item() == pytest.approx(np.exp(-0.25 * (4 + 9)))
    assert LinearKernel()(np.log([0.5]), a, b)[0].item() == pytest.approx(0.5 * (3 - 2))
    two_lags = RBFKernel(2)(np.log([0.5, 2.0]), a, b)[0].item()
    assert two_lags == pytest.approx(np.exp(-0.5 * (0.5 * 4 + 2.0 * 9)))


def test_lengthscales_are_those_of_the_rbf_parts():
    assert RBFKernel().lengthscales(np.log([0.25])) == pytest.approx((2.0,))
    assert linear_rbf(2).lengthscales(np.log([0.9, 0.25, 4.0, 0.1, 0.1])) == pytest.approx((2, 0.5))
