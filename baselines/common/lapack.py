"""Two LAPACK routines, called without Python's global interpreter lock.

scipy's wrappers hold the lock while they work, so that threads over outputs would wait for each
other. Here the same compiled routines are taken from `scipy.linalg.cython_lapack` and called
through ctypes, which releases the lock.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable

from scipy.linalg import cython_lapack

from mocapbench.basics.arrays import Array

__all__ = ["potrf", "potri"]


def _routine(capsule: object) -> Callable[[Array], int]:
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


_dpotrf = _routine(cython_lapack.__pyx_capi__["dpotrf"])
_dpotri = _routine(cython_lapack.__pyx_capi__["dpotri"])


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
