"""The frames of a recording that a player shows."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets import Frames

__all__ = ["LONGEST", "ShownWindow", "shown_frames"]

LONGEST = 10.0
"""Seconds."""
_RATE = 30.0
"""Frames per second at the least, where a recording has them; fewer than twice as many."""
_TOLERANCE = 1.001  # 59.99 frames per second are 60


class ShownWindow(NamedTuple):
    """The part of a recording that a player shows.

    Parameters
    ----------
    times : ndarray of shape (N,)
        Of all frames, in seconds.
    hidden : ndarray of bool of shape (N,)
        Of which frames something is hidden.
    """

    times: Frames
    hidden: NDArray[np.bool_]

    @property
    def rows(self) -> NDArray[np.intp]:
        """The frames to show; see `shown_frames`."""
        return shown_frames(self.times, self.hidden)

    @property
    def part(self) -> slice:
        """The first to the last of them, with all between."""
        rows = self.rows
        return slice(int(rows[0]), int(rows[-1]) + 1)


def shown_frames(times: Frames, hidden: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Return which frames to show: at most `LONGEST`, with the first hidden ones in their middle.

    Parameters
    ----------
    times : ndarray of shape (N,)
        In seconds.
    hidden : ndarray of bool of shape (N,)
        All False where nothing is hidden.
    """
    step = max(int(_TOLERANCE * _frame_rate(times) / _RATE), 1)
    rows = np.arange(0, len(times), step)
    first = int(np.argmax(hidden))
    stop = min(_end_of_run(hidden, first), int(np.searchsorted(times, times[first] + LONGEST)))
    middle = (times[first] + times[stop - 1]) / 2.0
    start = np.clip(middle - LONGEST / 2.0, times[0], max(times[-1] - LONGEST, times[0]))
    return np.asarray(rows[(times[rows] >= start) & (times[rows] <= start + LONGEST)])


def _frame_rate(times: Frames) -> float:
    return float((len(times) - 1) / (times[-1] - times[0])) if len(times) > 1 else _RATE


def _end_of_run(hidden: NDArray[np.bool_], first: int) -> int:
    """Return where the run of equal values from ``first`` on has ended."""
    changes = np.flatnonzero(hidden[first:] != hidden[first])
    return first + int(changes[0]) if len(changes) else len(hidden)
