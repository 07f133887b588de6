"""Angle wrapping: angles are unwrapped where a file is read, and wrapped where it is written.

A file that keeps angles within [−180°, 180°) has a jump of 360° wherever a joint passes 180°. No
model should see that jump, and no file should be given angles outside the range that it keeps.

Angles of several recordings that differ by multiples of 360° are the same: one person may have
turned round before the recording began, and another program counts from 0° where the database
counts from −180°. Such offsets are found from the mean direction of an angle in training, which
multiples of 360° do not change.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.datasets.formats.quaternions import (
    align_quaternions,
    find_quaternions,
    finish_quaternions,
)
from mocapbench.datasets.recording import FrameByChannel, Frames, Mask, Recording

__all__ = ["mean_directions", "unwrap_angles", "wrap_angles", "wrapping_offsets"]

_PERIODS = {"deg": 360.0, "rad": 2.0 * np.pi}
"""360° in each unit of angle."""


def unwrap_angles(recording: Recording) -> Recording:
    """Return the recording with no jump of more than 180° between visible angles.

    Channels whose unit is ``"deg"`` or ``"rad"`` are changed by multiples of 360°, quaternions by
    their sign (``align_quaternions``), the others not at all.
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
    if not _has_rotations(recording):
        return recording
    values = align_quaternions(recording.values, recording.channels)
    for channel, unit in enumerate(recording.units):
        if unit in _PERIODS:
            values[:, channel] = _unwrap(values[:, channel], _PERIODS[unit])
    return recording.with_values(values)


def wrap_angles(values: FrameByChannel, original: Recording, new: Mask) -> FrameByChannel:
    """Return unwrapped values in the ranges that the angles of a file keep.

    That is [−180°, 180°) if all its visible angles of the channel lie there, else [0°, 360°] if
    they lie there. A channel that keeps neither is unwrapped in the file, and the new values
    continue from the visible entry before. Quaternions have the length 1 (`finish_quaternions`).

    Parameters
    ----------
    values : ndarray of shape (N, D)
        Values that continue ``unwrap_angles(original)``.
    original : Recording
        What stays of the file, as it stands there.
    new : ndarray of bool of shape (N, D)
        The entries that are to be written; others are returned as they are.
    """
    if not _has_rotations(original):
        return values
    result = finish_quaternions(values, original.channels, original.values, new)
    for channel, unit in enumerate(original.units):
        rows = new[:, channel]
        if unit in _PERIODS and rows.any():
            kept = original.values[:, channel]
            result[rows, channel] = _wrap_as_kept(values[:, channel], kept, _PERIODS[unit])[rows]
    return result


def _has_rotations(recording: Recording) -> bool:
    """Return whether any channel is an angle, or a part of a quaternion."""
    angles = any(unit in _PERIODS for unit in recording.units)
    return angles or bool(find_quaternions(recording.values, recording.channels))


def mean_directions(recordings: Sequence[Recording]) -> Array:
    """Return the circular mean (D,) of each angle over visible entries, in its unit.

    It is 0 for channels that are no angles, or have no visible entry.
    """
    values = np.concatenate([recording.values for recording in recordings])
    periods, angles = _list_periods(recordings[0]), np.zeros(values.shape[1])
    known = ~np.isnan(periods)
    around = 2j * np.pi * values[:, known] / periods[known]
    angles[known] = np.angle(np.nansum(np.exp(around), axis=0)) * periods[known] / (2.0 * np.pi)
    return angles


def wrapping_offsets(recording: Recording, directions: Array) -> Array:
    """Return the multiple of 360° (D,), in each channel's unit, by which its mean is away.

    Parameters
    ----------
    recording : Recording
        N frames of D channels, unwrapped.
    directions : ndarray of shape (D,)
        As `mean_directions` returns them.

    Returns
    -------
    ndarray of shape (D,)
        What to subtract, so that the mean of each angle is within 180° of ``directions``;
        0 for channels that are no angles, or have no visible entry.
    """
    periods, seen = _list_periods(recording), recording.visible
    means = np.where(seen, recording.values, 0.0).sum(axis=0) / np.maximum(seen.sum(axis=0), 1)
    away = periods * np.round((means - directions) / periods)
    return np.where(seen.any(axis=0), np.nan_to_num(away), 0.0)


def _unwrap(angles: Frames, period: float) -> Frames:
    """Return the angles, less the multiples of 360° by which visible neighbours jump."""
    result, seen = angles.copy(), ~np.isnan(angles)
    jumps = np.round(np.diff(angles[seen]) / period)
    result[seen] -= period * np.concatenate([[0.0], np.cumsum(jumps)])[: seen.sum()]
    return result


def _wrap_as_kept(angles: Frames, kept: Frames, period: float) -> Frames:
    """Return the angles in the range of those that a file keeps (N,), NaN where it has none."""
    visible = kept[~np.isnan(kept)]
    if (np.abs(visible) <= period / 2).all():
        return _wrap_from(-period / 2, angles, period)
    if ((visible >= 0.0) & (visible <= period)).all():
        return _wrap_from(0.0, angles, period)
    return angles - _hold_last_value(_unwrap(kept, period) - kept)


def _wrap_from(low: float, angles: Frames, period: float) -> Frames:
    return angles - period * np.floor((angles - low) / period)


def _hold_last_value(offsets: Frames) -> Frames:
    """Return (N,) with each NaN replaced by the value before it, or else by the first one."""
    (seen,) = np.nonzero(~np.isnan(offsets))
    before = np.searchsorted(seen, np.arange(len(offsets)), side="right") - 1
    return offsets[seen[np.maximum(before, 0)]]


def _list_periods(recording: Recording) -> Array:
    """Return 360° in the unit of each channel (D,); NaN for what is no angle."""
    return np.array([_PERIODS.get(unit, np.nan) for unit in recording.units])
