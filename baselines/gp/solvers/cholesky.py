"""Inversion of positive definite matrices in place, those of size 0 included."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.lapack import potrf, potri
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.solver import SingularCovarianceError

__all__ = ["invert", "mirror"]

Array = NDArray[np.float64]


def invert(matrix: Array, parameters: Parameters) -> float:
    """Overwrite a C-ordered matrix, of which the lower triangle counts, with its inverse.

    Returns its log-determinant.

    Raises
    ------
    SingularCovarianceError
        If the matrix, built from ``parameters``, is not numerically positive definite.
    """
    if not matrix.size:
        return 0.0
    if potrf(matrix) != 0:
        raise SingularCovarianceError(parameters)
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
