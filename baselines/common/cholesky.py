"""Inverses of positive definite matrices, computed in place."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.lapack import potrf, potri
from mocapbench.basics.arrays import Array

__all__ = ["invert", "mirror"]


def invert(matrix: Array) -> float:
    """Overwrite a symmetric matrix with its inverse.

    Parameters
    ----------
    matrix : ndarray of shape (n, n), n ≥ 0
        C-ordered. Only the diagonal and what is below it are read.

    Returns
    -------
    float
        The log-determinant of the matrix; 0 for a matrix of size 0.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the matrix is not numerically positive definite.
    """
    if not matrix.size:
        return 0.0
    minor = potrf(matrix)
    if minor != 0:
        raise np.linalg.LinAlgError(
            f"expected a positive definite matrix, got one of shape {matrix.shape} whose leading "
            f"minor of order {minor} is not positive: add to its diagonal"
        )
    log_determinant = 2.0 * float(np.log(np.diagonal(matrix)).sum())
    potri(matrix)
    mirror(matrix)
    return log_determinant


def mirror(matrix: Array) -> None:
    """Overwrite the upper triangle of a square matrix with the lower one."""
    np.copyto(matrix, matrix.T, where=_above_diagonal(len(matrix)))


@lru_cache(maxsize=128)
def _above_diagonal(size: int) -> NDArray[np.bool_]:
    return ~np.tri(size, dtype=bool)
