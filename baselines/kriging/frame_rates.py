"""Recordings of many frames per second as ones of about 30, and fills of these in all frames.

Bodies move little within a thirtieth of a second, and covariances that count in frames mean the
same time then. A fill at few frames is carried over to all by a cubic spline.
"""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

from mocapbench.baselines.protocols import Prediction
from mocapbench.basics.arrays import Array, Index
from mocapbench.datasets import Recording

__all__ = ["keep_thirty_frames", "restore_frames"]

_RATE = 30.0
"""Frames per second of the recordings with which the defaults of models were chosen."""


def keep_thirty_frames(recording: Recording) -> tuple[Recording, Index]:
    """Return about 30 frames per second of a recording, and which ones (K,) of it they are.

    Every k-th frame is kept, from that of the first k on with which most are complete; in place of
    a hidden one a complete one that is nearer than k / 2, so that gaps begin and end where they do.
    Hidden frames beyond the ends of the recording are added so that none of its own is outside.
    """
    n_frames = len(recording.times)
    interval = float(np.median(np.diff(recording.times))) if n_frames > 1 else 1.0
    step = max(round(1.0 / (_RATE * interval)), 1)
    if step == 1:
        return recording, np.arange(n_frames)
    complete = np.asarray(recording.visible.all(axis=1))
    first = int(np.argmax([complete[start::step].sum() for start in range(step)]))
    # From the last place before the first frame on, to the first one after the last frame.
    kept = np.arange(first - step if first else 0, n_frames - 1 + step, step)
    kept = _move_to_complete(kept, np.flatnonzero(complete), step / 2.0)
    own = np.clip(kept, 0, n_frames - 1)
    values = recording.values[own]
    values[np.flatnonzero(own - kept)] = np.nan
    times = recording.times[own] + interval * (kept - own)
    return Recording(recording.name, times, values, recording.channels, recording.units), kept


def _move_to_complete(kept: Index, complete: Index, most: float) -> Index:
    """Return each frame's nearest complete one if it is nearer than ``most``; else the frame."""
    if not len(complete):
        return kept
    after = np.clip(np.searchsorted(complete, kept), 0, len(complete) - 1)
    ways = np.array([complete[np.maximum(after - 1, 0)], complete[after]])
    nearest = ways[np.abs(ways - kept).argmin(axis=0), np.arange(len(kept))]
    return np.asarray(np.where(np.abs(nearest - kept) < most, nearest, kept))


def restore_frames(recording: Recording, found: Prediction, kept: Index) -> Prediction:
    """Return the prediction of all frames from that of those that `keep_thirty_frames` kept.

    The mean is a cubic spline through these and all visible frames; the variance is linear between
    them.
    """
    frames = np.arange(len(recording.times))
    if np.array_equal(kept, frames):
        return found
    visible = np.flatnonzero(recording.visible.all(axis=1))
    knots = np.union1d(kept, visible)
    mean, variance = _at_knots(recording, found.mean, kept, knots, visible), found.variance
    if variance is not None:
        known = _at_knots(recording, variance, kept, knots, visible)
        known[np.isin(knots, visible)] = 0.0
        variance = np.array([np.interp(frames, knots, each) for each in known.T]).T
    return Prediction.around(recording, CubicSpline(knots, mean)(frames), variance)


def _at_knots(
    recording: Recording, values: Array, kept: Index, knots: Index, visible: Index
) -> Array:
    """Return ``values`` of the frames kept, and those of the recording in all visible ones."""
    known = np.empty((len(knots), values.shape[1]))
    known[np.searchsorted(knots, kept)] = values
    known[np.searchsorted(knots, visible)] = recording.values[visible]
    return known
