"""The frames of several recordings, each seen with the frames before and after it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from sklearn.linear_model import Ridge

from mocapbench.baselines.common.recordings import interpolate_channels, stack
from mocapbench.basics.arrays import Array, Index
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["StackedFrames"]


_BESIDE = np.array([-8, -4, 0, 4, 8])
"""The frames by which a frame is compared with others: those at these distances from it."""
_RIDGE = 0.01
"""Penalty of squared coefficients, per frame, where channels have variance 1."""
_LEAST_RELEVANCE = 1e-3


@dataclass(frozen=True, eq=False)
class StackedFrames:
    """The M frames of several recordings, one recording below the other.

    Parameters
    ----------
    values : ndarray of shape (M, D)
        NaN where hidden.
    windows : ndarray of shape (M, W, D)
        Each frame with W − 1 others before and after it, hidden entries interpolated over time.
    recording : ndarray of int, shape (M,)
        The number of each frame's recording.
    place : ndarray of int, shape (M,)
        The number of each frame in its recording.
    """

    values: FrameByChannel
    windows: Array
    recording: Index
    place: Index

    @classmethod
    def of(cls, recordings: Sequence[Recording]) -> Self:
        """Stack recordings with zero mean; it stands for a channel never visible in one."""
        lengths = [len(recording.times) for recording in recordings]
        return cls(
            stack(recordings),
            np.concatenate([_windows(recording) for recording in recordings]),
            np.repeat(np.arange(len(recordings)), lengths),
            np.concatenate([np.arange(length) for length in lengths]),
        )

    def describe_windows(self, frames: Index, channels: Index, weights: Array) -> Array:
        """Return the windows (n, W C) of frames in some channels, times weights (C,).

        They are divided by the root of W C: squared distances are means. One zero stands for no
        channels.
        """
        if not len(channels):
            return np.zeros((len(frames), 1))
        weighted = self.windows[np.ix_(frames, np.arange(len(_BESIDE)), channels)] * weights
        return np.asarray(weighted.reshape(len(frames), -1) / np.sqrt(weighted[0].size))

    def relevance(self, known: Index, channels: Index, others: Index) -> Array:
        """Return how much each of the others says of channels, in the frames known: (C,).

        It is the root of the mean squared coefficients of ridge regression, such that its mean
        square is 1.
        """
        if not len(others):
            return np.ones(0)
        middle = self.windows[known, len(_BESIDE) // 2]
        ridge = Ridge(alpha=_RIDGE * len(known)).fit(
            middle[:, others], self.values[known][:, channels]
        )
        coefficients = ridge.coef_.reshape(len(channels), -1)
        relevance = np.sqrt((coefficients**2).mean(axis=0)) + _LEAST_RELEVANCE
        return np.asarray(relevance / np.sqrt((relevance**2).mean()))


def _windows(recording: Recording) -> Array:
    """Return each frame with others beside it (N, W, D); the ends are held."""
    values = np.nan_to_num(interpolate_channels(recording.values, recording.times))
    places = np.arange(len(values))[:, None] + _BESIDE
    return np.asarray(values[np.clip(places, 0, len(values) - 1)])
