"""Angles that differ by whole turns are the same: those of several recordings, brought together.

A recording may have turned before it began, and another program counts from 0° where the database
counts from −180°. Whole turns are told from the mean direction of an angle in training, which
whole turns of a recording do not change.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["mean_directions", "wrapping_offsets"]


_TURN = {"deg": 360.0, "rad": 2.0 * np.pi}
"""One turn in each unit of angle."""


def mean_directions(recordings: Sequence[Recording]) -> Array:
    """Return the circular mean (D,) of each angle over visible entries, in its unit.

    It is 0 for channels that are no angles, or have no visible entry.
    """
    values = np.concatenate([recording.values for recording in recordings])
    turns, angles = _turns(recordings[0]), np.zeros(values.shape[1])
    known = ~np.isnan(turns)
    around = 2j * np.pi * values[:, known] / turns[known]
    angles[known] = np.angle(np.nansum(np.exp(around), axis=0)) * turns[known] / (2.0 * np.pi)
    return angles


def wrapping_offsets(recording: Recording, directions: Array) -> Array:
    """Return the whole turns (D,), in each channel's unit, by which its mean is away.

    Parameters
    ----------
    recording : Recording
        N frames of D channels, unwrapped.
    directions : ndarray of shape (D,)
        As `mean_directions` returns them.

    Returns
    -------
    ndarray of shape (D,)
        What to subtract, so that the mean of each angle is within half a turn of ``directions``;
        0 for channels that are no angles, or have no visible entry.
    """
    turns, seen = _turns(recording), recording.visible
    means = np.where(seen, recording.values, 0.0).sum(axis=0) / np.maximum(seen.sum(axis=0), 1)
    away = turns * np.round((means - directions) / turns)
    return np.where(seen.any(axis=0), np.nan_to_num(away), 0.0)


def _turns(recording: Recording) -> Array:
    """Return one turn in the unit of each channel (D,); NaN for what is no angle."""
    return np.array([_TURN.get(unit, np.nan) for unit in recording.units])
