import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.common.cholesky import invert


@given(st.integers(0, 6), st.integers(0, 99))
def test_the_inverse_is_symmetric_and_undoes_the_matrix(size, seed):
    root = np.random.default_rng(seed).standard_normal((size, size))
    matrix = root @ root.T + np.eye(size)
    # Entries above the diagonal are never read.
    inverse = np.where(np.tri(size, dtype=bool), matrix, np.nan)
    log_determinant = invert(inverse)
    np.testing.assert_array_equal(inverse, inverse.T)
    np.testing.assert_allclose(inverse @ matrix, np.eye(size), atol=1e-10)
    np.testing.assert_allclose(log_determinant, np.linalg.slogdet(matrix)[1], atol=1e-10)


def test_an_indefinite_matrix_is_refused():
    with pytest.raises(np.linalg.LinAlgError, match=r"positive definite.*\(2, 2\).*order 1"):
        invert(-np.eye(2))
