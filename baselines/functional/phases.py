"""The phases of frames on a common cycle, and recordings cut into cycles by them.

After Ormoneit et al. (2005): recordings are shifted to a reference curve so that its squared
prediction error is least, and the reference curve is the smooth periodic regression on the
recordings so shifted. A new recording is placed where the fitted curve predicts it best.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.baselines.functional.cycle_period import elapsed_times
from mocapbench.baselines.functional.fourier_series import (
    CurveStatistics,
    roughness,
    shift_matrices,
)
from mocapbench.basics.arrays import Array, Index
from mocapbench.datasets import Recording

__all__ = [
    "SHIFTS",
    "cut_cycles",
    "periodic_curve",
    "place_recording",
    "prediction_errors",
    "shift_together",
]

SHIFTS: Array = np.arange(120) / 120.0
"""The phases by which a recording may be shifted, in cycles."""

_MOST_ROUNDS = 50  # each lowers the objective over finitely many shifts; 5 to 10 are usual
_NO_GAIN = 1.0 - 1e-9  # a round that lowers the objective by less is rounding error
_CANDIDATES = 60  # lengths of a cycle that are tried for a new recording, each a few per cent apart
_MARGIN = 1.25  # how far beyond the fitted lengths a new recording's may be


def periodic_curve(statistics: CurveStatistics, smoothness: float) -> Array:
    """Return the penalised regression on all curves: coefficients (D, P).

    They minimise the squared error over visible entries plus ``smoothness`` times the roughness.
    """
    penalty = smoothness * np.diag(_penalty_weights(statistics))
    grams, cross = statistics.grams.sum(axis=0), statistics.cross.sum(axis=0)
    return np.asarray(np.linalg.solve(grams + penalty, cross[..., None])[..., 0])


def prediction_errors(statistics: CurveStatistics, curve: Array) -> Array:
    """Return the squared error of ``curve`` (D, P) for each recording at each shift: (K, G)."""
    matrices = shift_matrices(SHIFTS, (curve.shape[1] - 1) // 2)
    # bᵀ(u + s) c = bᵀ(u) Rᵀ c: the curve is shifted backwards instead of the recording forwards.
    moved = curve @ matrices
    # squares − 2 cᵀ cross + cᵀ gram c, for every recording and shift.
    outer = (moved[..., :, None] * moved[..., None, :]).reshape(len(SHIFTS), -1)
    n_curves = len(statistics.squares)
    quadratic = statistics.grams.reshape(n_curves, -1) @ outer.T
    linear = statistics.cross.reshape(n_curves, -1) @ moved.reshape(len(SHIFTS), -1).T
    return np.asarray(statistics.squares.sum(axis=1)[:, None] - 2.0 * linear + quadratic)


def shift_together(
    statistics: CurveStatistics, first: int, smoothness: float
) -> tuple[Array, Index, list[float]]:
    """Find shifts and reference curve in turn, from the curve of recording ``first`` alone.

    Parameters
    ----------
    statistics : CurveStatistics
        Of K recordings, each at phases that start at 0.
    first : int
        The recording to which all are shifted at first.
    smoothness : float
        Weight of the roughness of the reference curve.

    Returns
    -------
    curve : ndarray of shape (D, P)
        Coefficients of the reference curve.
    shifts : ndarray of int, shape (K,)
        The index into `SHIFTS` of each recording.
    objectives : list of float
        Squared error plus penalty after each round.
    """
    curve = periodic_curve(statistics.rows(np.array([first])), smoothness)
    shifts = prediction_errors(statistics, curve).argmin(axis=1)
    weights = smoothness * _penalty_weights(statistics)
    objectives = [np.inf]
    for _ in range(_MOST_ROUNDS):
        matrices = shift_matrices(SHIFTS[shifts], (curve.shape[1] - 1) // 2)
        curve = periodic_curve(statistics.shift_curves(matrices), smoothness)
        errors = prediction_errors(statistics, curve)
        shifts = errors.argmin(axis=1)
        objectives.append(float(errors.min(axis=1).sum() + (curve**2 @ weights).sum()))
        if objectives[-1] >= objectives[-2] * _NO_GAIN:
            break
    return curve, shifts, objectives[1:]


def place_recording(recording: Recording, curve: Array, periods: Array) -> Array:
    """Return the phase of each frame, in cycles, at which ``curve`` predicts it best: (N,).

    Length of a cycle and shift are those of the least squared error over visible entries. A few
    frames, which could be folded at any length, thus have a phase too.

    Parameters
    ----------
    recording : Recording
        In the units of the curve.
    curve : ndarray of shape (D, P)
        Coefficients of the reference curve.
    periods : ndarray of shape (K,)
        Lengths of the fitted recordings' cycles, in seconds.
    """
    # Errors of every length of a cycle at every shift; the least is chosen.
    candidates = np.geomspace(periods.min() / _MARGIN, periods.max() * _MARGIN, _CANDIDATES)
    paths = np.outer(1.0 / candidates, elapsed_times(recording))
    n_harmonics = (curve.shape[1] - 1) // 2
    statistics = CurveStatistics.of([(path, recording.values) for path in paths], n_harmonics)
    errors = prediction_errors(statistics, curve)
    period, shift = np.unravel_index(errors.argmin(), errors.shape)
    return np.asarray(SHIFTS[shift] + paths[period])


def cut_cycles(
    recordings: Sequence[Recording], phases: Sequence[Array]
) -> tuple[list[tuple[Array, Array]], Index]:
    """Cut recordings where their phase passes a whole number.

    Parameters
    ----------
    recordings : sequence of K Recording
    phases : sequence of ndarray, each of shape (N_k,)
        The rising phases of their frames.

    Returns
    -------
    curves : list of pairs of ndarray
        Phases (N_j,) and values (N_j, D) of each of J cycles, one recording after the other.
    owners : ndarray of int, shape (J,)
        The index of the recording that each is from.
    """
    breaks = [np.flatnonzero(np.diff(np.floor(path))) + 1 for path in phases]
    curves = [
        curve
        for recording, path, at in zip(recordings, phases, breaks, strict=True)
        for curve in zip(np.split(path, at), np.split(recording.values, at), strict=True)
    ]
    return curves, np.repeat(np.arange(len(recordings)), [len(at) + 1 for at in breaks])


def _penalty_weights(statistics: CurveStatistics) -> Array:
    return roughness((statistics.cross.shape[2] - 1) // 2)
