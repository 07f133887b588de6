"""Recordings shifted in phase to a common periodic curve, which is refitted in turn.

After Ormoneit et al. (2005): the offsets minimise the squared prediction error of a reference
curve, and the reference curve is the smooth periodic regression on the recordings so shifted.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.functional.basis import roughness, shift_matrices
from mocapbench.baselines.functional.statistics import CurveStatistics
from mocapbench.basics.arrays import Array

__all__ = [
    "SHIFTS",
    "Aligned",
    "periodic_curve",
    "prediction_errors",
    "shift_together",
]

SHIFTS: Array = np.arange(120) / 120.0
"""The phases by which a recording may be shifted, in cycles."""

_MOST_ROUNDS = 50  # each lowers the objective over finitely many shifts; 5 to 10 are usual


@dataclass(frozen=True, eq=False)
class Aligned:
    """The reference curve and the shifts of K recordings.

    Parameters
    ----------
    curve : ndarray of shape (D, P)
        Coefficients of the reference curve.
    shifts : ndarray of int, shape (K,)
        The index into `SHIFTS` of each recording.
    objectives : tuple of float
        Squared error plus penalty after each round.
    """

    curve: Array
    shifts: NDArray[np.intp]
    objectives: tuple[float, ...]


def periodic_curve(statistics: CurveStatistics, smoothness: float) -> Array:
    """Return the penalised regression on all curves: coefficients (D, P).

    They minimise the squared error over visible entries plus ``smoothness`` times the roughness.
    """
    penalty = smoothness * np.diag(_weights(statistics))
    grams, cross = statistics.grams.sum(axis=0), statistics.cross.sum(axis=0)
    return np.asarray(np.linalg.solve(grams + penalty, cross[..., None])[..., 0])


def prediction_errors(statistics: CurveStatistics, curve: Array) -> Array:
    """Return the squared error of ``curve`` (D, P) for each recording at each shift: (K, G)."""
    matrices = shift_matrices(SHIFTS, (curve.shape[1] - 1) // 2)
    # bᵀ(u + s) c = bᵀ(u) Rᵀ c: the curve is shifted backwards instead of the recording forwards.
    moved = curve @ matrices
    outer = (moved[..., :, None] * moved[..., None, :]).reshape(len(SHIFTS), -1)
    n_curves = len(statistics.squares)
    quadratic = statistics.grams.reshape(n_curves, -1) @ outer.T
    linear = statistics.cross.reshape(n_curves, -1) @ moved.reshape(len(SHIFTS), -1).T
    return np.asarray(statistics.squares.sum(axis=1)[:, None] - 2.0 * linear + quadratic)


def shift_together(statistics: CurveStatistics, first: int, smoothness: float) -> Aligned:
    """Return shifts and reference curve by turns, from the curve of recording ``first`` alone.

    Parameters
    ----------
    statistics : CurveStatistics
        Of K recordings, each at phases that start at 0.
    first : int
        The recording to which all are shifted at first.
    smoothness : float
        Weight of the roughness of the reference curve.
    """
    curve = periodic_curve(statistics.rows(np.array([first])), smoothness)
    shifts = prediction_errors(statistics, curve).argmin(axis=1)
    weights = smoothness * _weights(statistics)
    objectives = [np.inf]
    for _ in range(_MOST_ROUNDS):
        matrices = shift_matrices(SHIFTS[shifts], (curve.shape[1] - 1) // 2)
        curve = periodic_curve(statistics.shift_curves(matrices), smoothness)
        errors = prediction_errors(statistics, curve)
        shifts = errors.argmin(axis=1)
        objectives.append(float(errors.min(axis=1).sum() + (curve**2 @ weights).sum()))
        if objectives[-1] >= objectives[-2] * (1.0 - 1e-9):
            break
    return Aligned(curve, shifts, tuple(objectives[1:]))


def _weights(statistics: CurveStatistics) -> Array:
    return roughness((statistics.cross.shape[2] - 1) // 2)
