"""Whole turns of angles: unwrapped where a file is read, wrapped again where it is written.

A file that keeps angles within [−180°, 180°) has a jump of a turn wherever a joint passes 180°. No
model should see that jump, and no file should be given angles outside the range that it keeps.

Angles of several recordings that differ by whole turns are the same: one may have turned before it
began, and another program counts from 0° where the database counts from −180°. Such turns are told
from the mean direction of an angle in training, which whole turns of a recording do not change.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.datasets.recording import FrameByChannel, Frames, Mask, Recording

__all__ = ["mean_directions", "unwrap_angles", "wrap_angles", "wrapping_offsets"]

_TURN = {"deg": 360.0, "rad": 2.0 * np.pi}
"""One turn in each unit of angle."""


def unwrap_angles(recording: Recording) -> Recording:
    """Return the recording with no jump of more than half a turn between visible angles.

    Channels whose unit is ``"deg"`` or ``"rad"`` are changed by whole turns, the others not at all.
    Across a gap, the visible entries on its two sides are neighbours. Hiding entries can leave such
    a jump, so unwrap again after `Recording.hide`.

    Parameters
    ----------
    recording : Recording
        N frames of D channels.

    Examples
    --------
    >>> from mocapbench.datasets import Recording, unwrap_angles
    >>> turning = Recording("turn", [0.0, 0.1, 0.2], [[170.0], [float("nan")], [-175.0]],
    ...                     ["root.ry"], ["deg"])
    >>> unwrap_angles(turning).values.ravel()
    array([170.,  nan, 185.])
    """
    values = recording.values.copy()
    for channel, unit in enumerate(recording.units):
        if unit in _TURN:
            values[:, channel] = _continuous(values[:, channel], _TURN[unit])
    return recording.with_values(values)


def wrap_angles(values: FrameByChannel, original: Recording, new: Mask) -> FrameByChannel:
    """Return unwrapped values in the ranges that the angles of a file keep.

    That is [−½, ½) of a turn if all its visible angles of the channel lie there, else [0, 1] of a
    turn if they lie there. A channel that keeps neither counts its turns itself, and the new values
    continue the count of the visible entry before.

    Parameters
    ----------
    values : ndarray of shape (N, D)
        Values that continue ``unwrap_angles(original)``.
    original : Recording
        What stays of the file, as it stands there.
    new : ndarray of bool of shape (N, D)
        The entries that are to be written; others are returned as they are.
    """
    result = values.copy()
    for channel, unit in enumerate(original.units):
        rows = new[:, channel]
        if unit in _TURN and rows.any():
            kept = original.values[:, channel]
            result[rows, channel] = _in_range(values[:, channel], kept, _TURN[unit])[rows]
    return result


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


def _continuous(angles: Frames, turn: float) -> Frames:
    """Return the angles, less the turns by which neighbours among the visible ones jump."""
    result, seen = angles.copy(), ~np.isnan(angles)
    jumps = np.round(np.diff(angles[seen]) / turn)
    result[seen] -= turn * np.concatenate([[0.0], np.cumsum(jumps)])[: seen.sum()]
    return result


def _in_range(angles: Frames, kept: Frames, turn: float) -> Frames:
    """Return the angles in the range of those that a file keeps (N,), NaN where it has none."""
    visible = kept[~np.isnan(kept)]
    if (np.abs(visible) <= turn / 2).all():
        return _from(-turn / 2, angles, turn)
    if ((visible >= 0.0) & (visible <= turn)).all():
        return _from(0.0, angles, turn)
    return angles - _hold_last_value(_continuous(kept, turn) - kept)


def _from(low: float, angles: Frames, turn: float) -> Frames:
    return angles - turn * np.floor((angles - low) / turn)


def _hold_last_value(offsets: Frames) -> Frames:
    """Return (N,) with each NaN replaced by the value before it, or else by the first one."""
    (seen,) = np.nonzero(~np.isnan(offsets))
    before = np.searchsorted(seen, np.arange(len(offsets)), side="right") - 1
    return offsets[seen[np.maximum(before, 0)]]


def _turns(recording: Recording) -> Array:
    """Return one turn in the unit of each channel (D,); NaN for what is no angle."""
    return np.array([_TURN.get(unit, np.nan) for unit in recording.units])
