"""The frames of several recordings, each seen with the frames before and after it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray
from sklearn.metrics.pairwise import euclidean_distances

from mocapbench.baselines.common.recordings import stack
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["StackedFrames"]

Array = NDArray[np.float64]
Index = NDArray[np.intp]

_BESIDE = np.array([-4, -2, 0, 2, 4])
"""The frames by which a frame is compared with others: those at these distances from it."""


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
            np.concatenate([_windows(_interpolated(recording)) for recording in recordings]),
            np.repeat(np.arange(len(recordings)), lengths),
            np.concatenate([np.arange(length) for length in lengths]),
        )

    def distances(self, one: Index, other: Index, channels: Index) -> Array:
        """Return the mean squared differences (n, m) of the windows of frames in some channels.

        They are 0 without channels.
        """
        if not len(channels):
            return np.zeros((len(one), len(other)))
        wide = self.windows[:, :, channels].reshape(len(self.windows), -1)
        squares = euclidean_distances(wide[one], wide[other], squared=True)
        return np.asarray(squares / wide.shape[1])

    def together(self, one: Index, other: Index) -> Iterator[tuple[tuple[Index, ...], Array]]:
        """Yield, for each recording, where in an array (n, m) both frames are of it.

        With each place comes the number of frames between those frames.
        """
        for number in np.intersect1d(self.recording[one], self.recording[other]):
            rows, columns = (np.flatnonzero(self.recording[of] == number) for of in (one, other))
            lags = np.subtract.outer(self.place[one[rows]], self.place[other[columns]])
            yield np.ix_(rows, columns), np.abs(lags).astype(np.float64)


def _interpolated(recording: Recording) -> FrameByChannel:
    """Return the values with hidden entries interpolated linearly, or held at the ends."""
    times, values = recording.times, np.zeros_like(recording.values)
    for d, channel in enumerate(recording.values.T):
        seen = ~np.isnan(channel)
        if seen.any():
            values[:, d] = np.interp(times, times[seen], channel[seen])
    return values


def _windows(values: FrameByChannel) -> Array:
    """Return each frame with others beside it (N, W, D); the ends are held."""
    places = np.arange(len(values))[:, None] + _BESIDE
    return np.asarray(values[np.clip(places, 0, len(values) - 1)])
