"""Where a trial hides gaps: at places where everything is visible, clear of the real gaps."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

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
    n_starts = len(blocked) - len(episode) - 1
    if n_starts < 1:
        return np.empty(0, dtype=np.intp)
    starts = np.arange(1, n_starts + 1)
    free = np.ones(n_starts, dtype=bool)
    for gap in episode.gaps:
        counts = np.concatenate([[0], np.cumsum(blocked[:, list(gap.channels)].any(axis=1))])
        first = starts + (gap.start - episode.start)
        free &= counts[first + len(gap) + 1] == counts[first - 1]
    return starts[free]


def occupy(blocked: Mask, episode: Episode) -> None:
    """Block the frames of an episode and as many on both sides, in all channels.

    So that trial gaps do not make each other harder.
    """
    margin = len(episode)
    blocked[max(episode.start - margin, 0) : episode.stop + margin] = True
