"""The frames of several recordings, each seen with the frames before and after it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from sklearn.linear_model import Ridge

from mocapbench.baselines.common.recordings import interpolate_channels, stack
from mocapbench.baselines.kriging.described_frames import DescribedFrames
from mocapbench.basics.arrays import Array, Index
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["describe_by_channels", "stack_frames", "weigh_channels"]


_BESIDE = np.array([-8, -4, 0, 4, 8])
"""The frames by which a frame is compared with others: those at these distances from it."""
_RIDGE = 0.01
"""Penalty of squared coefficients, per frame, where channels have variance 1."""
_LEAST_RELEVANCE = 1e-3


def stack_frames(recordings: Sequence[Recording]) -> tuple[FrameByChannel, DescribedFrames]:
    """Return the M frames of several recordings with zero mean, one recording below the other.

    Returns
    -------
    values : ndarray of shape (M, D)
        NaN where hidden.
    frames : DescribedFrames
        By windows (M, W, D): each frame with W − 1 others before and after it, hidden entries
        interpolated over time. Zero stands for a channel never visible in a recording. Their times
        are their numbers in it.
    """
    lengths = [len(recording.times) for recording in recordings]
    frames = DescribedFrames(
        np.concatenate([_windows(recording) for recording in recordings]),
        np.concatenate([np.arange(length) for length in lengths]),
        np.repeat(np.arange(len(recordings)), lengths),
    )
    return stack(recordings), frames


def describe_by_channels(
    frames: DescribedFrames, channels: Index, weights: Array
) -> DescribedFrames:
    """Return n frames by their windows (n, W C) in some channels, times weights (C,).

    They are divided by the root of W C: squared distances are means. One zero stands for no
    channels.
    """
    n_frames = len(frames.times)
    if not len(channels):
        return replace(frames, description=np.zeros((n_frames, 1)))
    windows = frames.description[:, :, channels] * weights
    description = windows.reshape(n_frames, -1) / np.sqrt(windows[0].size)
    return replace(frames, description=description)


def weigh_channels(values: FrameByChannel, windows: Array, channels: Index, others: Index) -> Array:
    """Return how much each of the others says of channels, in frames that show these: (C,).

    It is the root of the mean squared coefficients of ridge regression, such that its mean
    square is 1.

    Parameters
    ----------
    values : ndarray of shape (n, D)
    windows : ndarray of shape (n, W, D)
        As in `stack_frames`.
    channels, others : ndarray of int
    """
    if not len(others):
        return np.ones(0)
    middle = windows[:, len(_BESIDE) // 2]
    ridge = Ridge(alpha=_RIDGE * len(values)).fit(middle[:, others], values[:, channels])
    coefficients = ridge.coef_.reshape(len(channels), -1)
    relevance = np.sqrt((coefficients**2).mean(axis=0)) + _LEAST_RELEVANCE
    return np.asarray(relevance / np.sqrt((relevance**2).mean()))


def _windows(recording: Recording) -> Array:
    """Return each frame with others beside it (N, W, D); the ends are held."""
    values = np.nan_to_num(interpolate_channels(recording.values, recording.times))
    places = np.arange(len(values))[:, None] + _BESIDE
    return np.asarray(values[np.clip(places, 0, len(values) - 1)])
