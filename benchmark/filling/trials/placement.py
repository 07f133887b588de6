"""Where a trial hides gaps: at places where everything is visible, clear of the real gaps."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.gaps import free_starts
from mocapbench.benchmark.filling.gaps import Episode
from mocapbench.datasets import Mask

__all__ = ["free_places", "occupy"]

Frames = NDArray[np.intp]


def free_places(episode: Episode, blocked: Mask) -> Frames:
    """Return the frames at which a copy of the episode may start.

    Each of its gaps must lie, with a frame on both sides, where its channels are not blocked.

    Parameters
    ----------
    episode : Episode
    blocked : ndarray of bool of shape (N, D)
        Entries that are hidden, or must not be.

    Returns
    -------
    ndarray of int, ascending
    """
    starts = np.arange(1, len(blocked) - len(episode))
    for gap in episode.gaps:
        of_gap = free_starts(np.asarray(blocked[:, list(gap.channels)].any(axis=1)), len(gap))
        starts = np.intersect1d(starts, of_gap - (gap.start - episode.start), assume_unique=True)
    return starts


def occupy(blocked: Mask, episode: Episode) -> None:
    """Block the frames of an episode and as many on both sides, in all channels.

    So that trial gaps do not make each other harder.
    """
    margin = len(episode)
    blocked[max(episode.start - margin, 0) : episode.stop + margin] = True
