"""Recordings on the cycle of a fitted model: their phases."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.functional.period import elapsed_times
from mocapbench.baselines.functional.shifts import SHIFTS, prediction_errors
from mocapbench.baselines.functional.statistics import CurveStatistics
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["place"]

_CANDIDATES = 60
_MARGIN = 1.25  # how far beyond the fitted lengths a new recording's may be


def place(recording: Recording, curve: Array, periods: Array) -> Array:
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
    candidates = np.geomspace(periods.min() / _MARGIN, periods.max() * _MARGIN, _CANDIDATES)
    paths = np.outer(1.0 / candidates, elapsed_times(recording))
    n_harmonics = (curve.shape[1] - 1) // 2
    statistics = CurveStatistics.of([(path, recording.values) for path in paths], n_harmonics)
    errors = prediction_errors(statistics, curve)
    period, shift = np.unravel_index(errors.argmin(), errors.shape)
    return np.asarray(SHIFTS[shift] + paths[period])
