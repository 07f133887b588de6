"""Cholesky factors and inverses of positive definite matrices, computed in place.

scipy's wrappers of LAPACK hold Python's global interpreter lock while they work, so that threads
over outputs would wait for each other. Here the same compiled routines are taken from
`scipy.linalg.cython_lapack` and called through ctypes, which releases the lock.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cython_lapack

from mocapbench.basics.arrays import Array

__all__ = ["decompose", "invert", "mirror", "potrf", "potri"]


def _load_routine(capsule: object) -> Callable[[Array], int]:
    """Return a LAPACK routine (uplo, n, a, lda, info) as a function from a to info."""
    of_name = ctypes.pythonapi.PyCapsule_GetName
    of_name.restype, of_name.argtypes = ctypes.c_char_p, [ctypes.py_object]
    address_of = ctypes.pythonapi.PyCapsule_GetPointer
    address_of.restype = ctypes.c_void_p
    address_of.argtypes = [ctypes.py_object, ctypes.c_char_p]
    pointer = ctypes.POINTER(ctypes.c_int)
    signature = ctypes.CFUNCTYPE(None, ctypes.c_char_p, pointer, ctypes.c_void_p, pointer, pointer)
    function = signature(address_of(capsule, of_name(capsule)))

    def call(matrix: Array) -> int:
        size, info = ctypes.c_int(len(matrix)), ctypes.c_int()
        function(b"U", size, matrix.ctypes.data, size, info)
        return info.value

    return call


_dpotrf = _load_routine(cython_lapack.__pyx_capi__["dpotrf"])
_dpotri = _load_routine(cython_lapack.__pyx_capi__["dpotri"])


def potrf(matrix: Array) -> int:
    """Overwrite the lower triangle of a C-ordered matrix with its Cholesky factor.

    The lower triangle of a C-ordered array is the upper one of the Fortran-ordered array that
    LAPACK sees.

    Returns
    -------
    int
        0, or the order of the leading minor that is not positive definite.
    """
    return _dpotrf(matrix)


def potri(factor: Array) -> int:
    """Overwrite a lower Cholesky factor (`potrf`) with the lower triangle of the inverse.

    Returns
    -------
    int
        0, or the index, counted from 1, of a zero on the factor's diagonal.
    """
    return _dpotri(factor)


def decompose(matrix: Array) -> None:
    """Overwrite the lower triangle of a symmetric matrix with its Cholesky factor.

    Parameters
    ----------
    matrix : ndarray of shape (n, n), n ≥ 1
        C-ordered. Only the diagonal and what is below it are read.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the matrix is not numerically positive definite.
    """
    minor = potrf(matrix)
    if minor != 0:
        raise np.linalg.LinAlgError(
            f"expected a positive definite matrix, got one of shape {matrix.shape} whose leading "
            f"minor of order {minor} is not positive: add to its diagonal"
        )


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
    decompose(matrix)
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
