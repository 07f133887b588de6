"""Factorisation and inversion of positive definite matrices, those of size 0 included."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack, solve_triangular

from mocapbench.baselines.gp.parameters import Parameters
from mocapbench.baselines.gp.solver import SingularCovarianceError

__all__ = ["factorise", "invert", "invert_factor", "solve_lower"]

Array = NDArray[np.float64]


def factorise(matrix: Array, parameters: Parameters) -> tuple[Array, float]:
    """Return lower Cholesky factor and log-determinant of a matrix, which is overwritten.

    Raises
    ------
    SingularCovarianceError
        If the matrix, built from ``parameters``, is not numerically positive definite.
    """
    if not matrix.size:
        return matrix, 0.0
    factor, info = lapack.dpotrf(matrix.T, lower=1, clean=1, overwrite_a=1)
    if info != 0:
        raise SingularCovarianceError(parameters)
    return factor, 2.0 * float(np.log(np.diagonal(factor)).sum())


def invert_factor(factor: Array) -> Array:
    """Return (L Lᵀ)⁻¹ for a lower Cholesky factor L."""
    if not factor.size:
        return factor
    lower, _ = lapack.dpotri(factor, lower=1)
    inverse = lower + lower.T
    inverse.reshape(-1)[:: len(inverse) + 1] *= 0.5
    return np.asarray(inverse)


def invert(matrix: Array, parameters: Parameters) -> tuple[Array, float]:
    """Return inverse and log-determinant of a matrix, which is overwritten; see `factorise`."""
    factor, log_determinant = factorise(matrix, parameters)
    return invert_factor(factor), log_determinant


def solve_lower(factor: Array, right: Array) -> Array:
    """Return L⁻¹ R for a lower Cholesky factor L."""
    if not factor.size:
        return right
    return np.asarray(solve_triangular(factor, right, lower=True, check_finite=False))
