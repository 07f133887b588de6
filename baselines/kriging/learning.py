"""A process over frames: the parameters that predict best what is left out, and predictions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import Bounds, minimize

from mocapbench.baselines.kriging.left_out_gaps import LeftOutGaps
from mocapbench.basics.arrays import Array, Index

__all__ = [
    "Pairs",
    "best_predicting",
    "evenly",
    "noisy",
    "predict_frames",
    "some_of_both",
    "stretch_numbers",
]


_WIDTH = 4.0
"""Most deviations of a logarithm from its prior median."""
_STEPS = 15
"""Of the search: more change predictions little."""
_FEWEST_GAPS = 4
"""Gaps that are left out are shorter than the one to fill where there would be fewer."""
_JITTER = 1e-6


class Pairs(Protocol):
    """How n frames are related to m others, in the eyes of a process with P parameters."""

    def covariance(self, parameters: Array) -> Array:
        """Return the covariance (n, m), noise left out; parameters (P,) are logarithms.

        The last of them is that of the standard deviation of the noise.
        """
        ...

    def derivatives(self, parameters: Array) -> Sequence[Array]:
        """Return those of the covariance by the parameters, the last of them left out."""
        ...


def best_predicting(
    pairs: Pairs, values: Array, stretch: Index, typical: Array, weight: float
) -> Array:
    """Return the parameters (P,) with which each stretch of frames is predicted best.

    They have the least negative log-density of what is left out (`LeftOutGaps`) times the weight,
    and of normal priors of logarithms, with standard deviation 1.

    Parameters
    ----------
    pairs : Pairs
        Of n frames with themselves.
    values : ndarray of shape (n, O)
        With a mean square of 1.
    stretch : ndarray of int, shape (n,)
        The number of each frame's stretch.
    typical : ndarray of shape (P,)
        The medians of the priors.
    weight : float
        What the density of one value counts.
    """

    def objective(parameters: Array) -> tuple[float, Array]:
        left_out = LeftOutGaps(noisy(pairs, parameters), values, stretch)
        by = [np.vdot(left_out.sensitivity, each) for each in pairs.derivatives(parameters)]
        by.append(2.0 * np.exp(2.0 * parameters[-1]) * np.trace(left_out.sensitivity))
        deviations = parameters - typical
        score = weight * left_out.score + 0.5 * float(deviations @ deviations)
        return score, weight * np.array(by) + deviations

    found = minimize(
        objective,
        typical,
        jac=True,
        method="L-BFGS-B",
        bounds=Bounds(typical - _WIDTH, typical + _WIDTH),
        options={"maxiter": _STEPS},
    )
    return np.asarray(found.x)


def predict_frames(
    known: Pairs, across: Pairs, parameters: Array, values: Array
) -> tuple[Array, Array]:
    """Return the mean in m frames given n others, and by how much that lessens their variances.

    C. E. Rasmussen and C. K. I. Williams (2006), Gaussian Processes for Machine Learning, MIT
    Press, eq. (2.25) and (2.26).

    Parameters
    ----------
    known : Pairs
        Of the n frames with themselves.
    across : Pairs
        Of the m frames with the n.
    parameters : ndarray of shape (P,)
    values : ndarray of shape (n, O)

    Returns
    -------
    mean : ndarray of shape (m, O)
    explained : ndarray of shape (m,)
    """
    factor, cross = cho_factor(noisy(known, parameters), lower=True), across.covariance(parameters)
    explained = (cross * cho_solve(factor, cross.T).T).sum(axis=1)
    return cross @ cho_solve(factor, values), explained


def noisy(pairs: Pairs, parameters: Array) -> Array:
    """Return the covariance (n, n) of frames with themselves, noise included."""
    covariance = pairs.covariance(parameters)
    covariance[np.diag_indices_from(covariance)] += np.exp(2.0 * parameters[-1]) + _JITTER
    return covariance


def stretch_numbers(
    times: NDArray[np.float64 | np.intp], recording: Index, duration: float
) -> Index:
    """Return the numbers (n,) of stretches that last so long, or less if they would be few.

    Parameters
    ----------
    times : ndarray of shape (n,)
    recording : ndarray of int, shape (n,)
        The number of each frame's recording.
    duration : float
        In the unit of times.
    """
    numbers, each = np.unique(recording, return_inverse=True)
    first = np.array([times[recording == number].min() for number in numbers])
    since = times - first[each]
    total = sum(since[recording == number].max() for number in numbers)
    number = since // max(min(duration, total / _FEWEST_GAPS), np.finfo(np.float64).tiny)
    _, stretch = np.unique(np.column_stack([recording, number]), axis=0, return_inverse=True)
    return np.asarray(stretch.ravel())


def evenly(rows: Index, most: int) -> Index:
    """Return at most so many of the rows, spread evenly."""
    places = np.linspace(0, len(rows) - 1, min(most, len(rows)))
    return np.asarray(rows[places.round().astype(int)])


def some_of_both(own: NDArray[np.bool_], most: int) -> Index:
    """Return at most so many frames of a recording, and as many of all others, spread evenly.

    Parameters
    ----------
    own : ndarray of bool, shape (n,)
        Which frames are of the recording.
    most : int
    """
    return np.concatenate([evenly(np.flatnonzero(own == mine), most) for mine in (True, False)])
