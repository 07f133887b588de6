import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.gp.cholesky import factorise, invert, solve_lower
from mocapbench.baselines.gp.parameters import Parameters
from mocapbench.baselines.gp.solver import SingularCovarianceError

NOWHERE = Parameters({}, np.zeros(1))


def positive_definite(size: int, seed: int) -> np.ndarray:
    root = np.random.default_rng(seed).standard_normal((size, size))
    return root @ root.T + np.eye(size)


@given(st.integers(0, 6), st.integers(0, 99))
def test_the_inverse_is_symmetric_and_undoes_the_matrix(size, seed):
    matrix = positive_definite(size, seed)
    inverse, log_determinant = invert(matrix.copy(), NOWHERE)
    np.testing.assert_array_equal(inverse, inverse.T)
    np.testing.assert_allclose(inverse @ matrix, np.eye(size), atol=1e-10)
    np.testing.assert_allclose(log_determinant, np.linalg.slogdet(matrix)[1], atol=1e-10)


@given(st.integers(0, 6), st.integers(0, 99))
def test_the_factor_is_lower_and_solves(size, seed):
    matrix = positive_definite(size, seed)
    factor, _ = factorise(matrix.copy(), NOWHERE)
    np.testing.assert_array_equal(factor, np.tril(factor))
    half = solve_lower(factor, matrix)
    np.testing.assert_allclose(half, factor.T, atol=1e-10)


def test_an_indefinite_matrix_is_named():
    with pytest.raises(SingularCovarianceError, match="expected a positive definite covariance"):
        factorise(-np.eye(2), NOWHERE)
