"""Frames of several recordings, by what is seen in each, and which of them count."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from sklearn.metrics.pairwise import euclidean_distances

from mocapbench.basics.arrays import Array, Index

__all__ = ["DescribedFrames", "choose_evenly", "choose_from_both", "choose_near"]

_ASKING = 100
"""Frames that are wanted which choose others, spread evenly."""


@dataclass(frozen=True, eq=False)
class DescribedFrames:
    """Frames of several recordings, by what is seen in each.

    Parameters
    ----------
    description : ndarray of shape (n, F) or (n, P, F)
        Of P parts, if there are several, each with a mean square of 1, summed over F; zero where
        nothing describes frames.
    times : ndarray of shape (n,)
        In frames or in seconds, within each recording.
    recording : ndarray of int, shape (n,)
        The number of its recording.
    """

    description: Array
    times: NDArray[np.float64 | np.intp]
    recording: Index

    def at(self, which: Index | slice) -> DescribedFrames:
        """Return some of the frames."""
        return DescribedFrames(self.description[which], self.times[which], self.recording[which])


def choose_evenly(recording: Index, most: int) -> Index:
    """Return the places of about so many of n frames, spread evenly over each recording.

    Each recording gives its share of them, rounded up, so that the order of recordings means
    nothing, and none is left out.

    Parameters
    ----------
    recording : ndarray of int, shape (n,)
        The number of each frame's recording.
    most : int
    """
    n_frames = len(recording)
    parts = [np.flatnonzero(recording == number) for number in np.unique(recording)]
    shares = [-(-min(most, n_frames) * len(part) // n_frames) for part in parts]
    chosen = [_spread(part, number) for part, number in zip(parts, shares, strict=True)]
    return np.concatenate([np.zeros(0, dtype=np.intp), *chosen])


def _spread(places: Index, number: int) -> Index:
    """Return so many of the places: both ends and others between them, or the middle one."""
    if number == 1:
        return np.asarray(places[[len(places) // 2]])
    return np.asarray(places[np.linspace(0, len(places) - 1, number).round().astype(int)])


def choose_near(frames: DescribedFrames, wanted: DescribedFrames, own: int, most: int) -> Index:
    """Return the frames of a recording, and of others those most like the ones that are wanted.

    The others are the nearest of each frame that is wanted, then the second nearest, and so on, so
    that what is rare among those wanted has its own too.

    Parameters
    ----------
    frames, wanted : DescribedFrames
    own : int
        The number of the recording.
    most : int
        How many of others at the most.

    Returns
    -------
    ndarray of int
        Places in ``frames``, in ascending order.
    """
    mine = frames.recording == own
    others = np.flatnonzero(~mine)
    if len(others) > most:
        asking = wanted.at(choose_evenly(wanted.recording, _ASKING))
        apart = euclidean_distances(
            *(
                each.description.reshape(len(each.times), -1)
                for each in (asking, frames.at(others))
            ),
            squared=True,
        )
        nearest = np.argsort(apart, axis=1, kind="stable")
        others = others[pd.unique(nearest.T.ravel())[:most]]
    return np.sort(np.concatenate([np.flatnonzero(mine), others]))


def choose_from_both(recording: Index, own: int, most: int) -> Index:
    """Return about so many frames of a recording, and as many of all others, spread evenly.

    Parameters
    ----------
    recording : ndarray of int, shape (n,)
        The number of each frame's recording.
    own : int
        The number of the recording.
    most : int
    """
    sides = [np.flatnonzero((recording == own) == mine) for mine in (True, False)]
    return np.concatenate([side[choose_evenly(recording[side], most)] for side in sides])
