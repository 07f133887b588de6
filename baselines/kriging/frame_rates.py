"""Recordings of many frames per second as ones of 30, and fills of these in all frames.

Bodies move little within a thirtieth of a second, and covariances that count in frames mean the
same time then. Where 30 frames per second lie between those of the recording, a cubic spline gives
them; another one carries a fill over to all frames.
"""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline, make_interp_spline

from mocapbench.baselines.protocols import Prediction
from mocapbench.basics.arrays import Array
from mocapbench.basics.mask_runs import runs
from mocapbench.datasets import Mask, Recording

__all__ = ["keep_thirty_frames", "restore_frames"]

_RATE = 30.0
"""Frames per second of the recordings with which the defaults of models were chosen."""
_DECIMALS = 6
"""Of a frame, to which its place counts: times of frames are no better known."""


def keep_thirty_frames(recording: Recording) -> tuple[Recording, Array]:
    """Return 30 frames per second of a recording, and which places (K,) in it they have.

    Places are counted in frames, and may lie between two. The first one is that of the frames
    before the second place with which most are between complete frames. In place of a hidden one a
    complete frame is taken that is nearer than half a step, so that gaps begin and end where they
    do. Where an end of the recording is hidden, a hidden place beyond it is added. Of 45 frames per
    second or fewer all are kept.
    """
    n_frames = len(recording.times)
    interval = float(np.median(np.diff(recording.times))) if n_frames > 1 else 1.0
    step = 1.0 / (_RATE * interval)
    if round(step) <= 1:
        return recording, np.arange(n_frames, dtype=np.float64)
    complete = np.asarray(recording.visible.all(axis=1))
    places = _choose_places(complete, step)
    places = _move_to_complete(places, complete, step / 2.0)
    values = _interpolate(recording.values, complete, places)
    times = recording.times[0] + interval * places
    return Recording(recording.name, times, values, recording.channels, recording.units), places


def _choose_places(complete: Mask, step: float) -> Array:
    """Return places a step apart, most of which are between complete frames."""
    last = len(complete) - 1
    each = [start + _count_steps(last - start, step) for start in range(round(step))]
    chosen = each[int(np.argmax([_between_complete(complete, places).sum() for places in each]))]
    if chosen[0] > 0 and not complete[0]:
        chosen = np.append(chosen[0] - step, chosen)
    if chosen[-1] < last and not complete[-1]:
        chosen = np.append(chosen, chosen[-1] + step)
    return np.round(chosen, _DECIMALS)


def _count_steps(length: float, step: float) -> Array:
    """Return multiples of a step from 0 to ``length``."""
    return np.round(step * np.arange(int(length / step + 1e-6) + 1), _DECIMALS)


def _between_complete(complete: Mask, places: Array) -> Mask:
    """Return which places (K,) are those of complete frames or between two that follow."""
    inside = (places >= 0) & (places <= len(complete) - 1)
    near = np.where(inside, places, 0.0)
    beside = complete[np.floor(near).astype(int)] & complete[np.ceil(near).astype(int)]
    return np.asarray(inside & beside)


def _move_to_complete(places: Array, complete: Mask, most: float) -> Array:
    """Return for each hidden place the nearest complete frame if that is nearer than ``most``."""
    known = np.flatnonzero(complete)
    if not len(known):
        return places
    after = np.clip(np.searchsorted(known, places), 0, len(known) - 1)
    ways = np.array([known[np.maximum(after - 1, 0)], known[after]])
    nearest = ways[np.abs(ways - places).argmin(axis=0), np.arange(len(places))]
    moved = ~_between_complete(complete, places) & (np.abs(nearest - places) < most)
    return np.asarray(np.where(moved, nearest, places))


def _interpolate(values: Array, complete: Mask, places: Array) -> Array:
    """Return the values (K, D) between complete frames, by a spline through each stretch of them.

    NaN elsewhere.
    """
    found = np.full((len(places), values.shape[1]), np.nan)
    for stretch in runs(complete):
        inside = (places >= stretch[0]) & (places <= stretch[-1])
        if inside.any():
            spline = make_interp_spline(stretch, values[stretch], k=min(3, len(stretch) - 1))
            found[inside] = spline(places[inside])
    return found


def restore_frames(recording: Recording, found: Prediction, places: Array) -> Prediction:
    """Return the prediction of all frames from that of the places that `keep_thirty_frames` kept.

    The mean is a cubic spline through the hidden ones and all visible frames; the variance is
    linear between them.
    """
    frames = np.arange(len(recording.times))
    if np.array_equal(places, frames):
        return found
    complete = np.asarray(recording.visible.all(axis=1))
    visible, hidden = np.flatnonzero(complete), ~_between_complete(complete, places)
    knots = np.concatenate([visible, places[hidden]])
    order = np.argsort(knots)
    mean = np.concatenate([recording.values[visible], found.mean[hidden]])
    mean = CubicSpline(knots[order], mean[order])(frames)
    if found.variance is None:
        return Prediction.around(recording, mean)
    variance = np.concatenate([np.zeros_like(recording.values[visible]), found.variance[hidden]])
    linear = [np.interp(frames, knots[order], each) for each in variance[order].T]
    return Prediction.around(recording, mean, np.array(linear).T)
