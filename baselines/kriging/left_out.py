"""How wrong a process is about recordings that it has not seen."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dpotri

from mocapbench.baselines.common.cholesky import invert

__all__ = ["left_out_scales"]

Array = NDArray[np.float64]
Index = NDArray[np.intp]


def left_out_scales(factor: Array, dual: Array, recording: Index) -> Array:
    """Return the variance of each channel relative to the prior: (C,).

    It is the mean ratio of squared errors to variances where every recording in turn is predicted
    from the others (C. E. Rasmussen and C. K. I. Williams (2006), Gaussian Processes for Machine
    Learning, MIT Press, eq. (5.12), with recordings in place of points).

    Parameters
    ----------
    factor : ndarray of shape (M, M)
        The lower Cholesky factor of the covariance; overwritten.
    dual : ndarray of shape (M, C)
        What the inverse of the covariance makes of the values.
    recording : ndarray of int, shape (M,)
        The number of each frame's recording.
    """
    precision, _ = dpotri(factor, lower=True, overwrite_c=True)
    ratios = []
    for number in np.unique(recording):
        own = np.flatnonzero(recording == number)
        covariance = precision[np.ix_(own, own)]
        invert(covariance)  # of its lower triangle, which is all that dpotri writes
        ratios.append((covariance @ dual[own]) ** 2 / np.diagonal(covariance)[:, None])
    return np.asarray(np.concatenate(ratios).mean(axis=0))
