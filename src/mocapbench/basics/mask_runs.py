"""Gaps of a mask: runs of hidden entries, what is hidden together, and where a gap would fit."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mocapbench.basics.arrays import Array, Index, Mask

__all__ = [
    "MOST_HIDDEN",
    "distances",
    "frames_alike",
    "free_starts",
    "hidden_together",
    "run_bounds",
    "runs",
    "whole_gaps",
]

MOST_HIDDEN = 0.15
"""Of the frames in question, the share that held-out gaps hide, unless one alone is longer."""


def run_bounds(frames: Mask) -> Index:
    """Return where each unbroken run of True in ``frames`` (N,) begins, and has ended: (K, 2)."""
    edges = np.flatnonzero(np.diff(np.pad(frames, 1).astype(np.int8)))
    return edges.reshape(-1, 2)


def runs(frames: Mask) -> list[Index]:
    """Return the indices of each unbroken run of True in ``frames`` (N,)."""
    return [np.arange(start, stop) for start, stop in run_bounds(frames).tolist()]


def free_starts(blocked: Mask, length: int) -> Index:
    """Return where ``length`` free frames in a row begin that have a free one on both sides.

    Parameters
    ----------
    blocked : ndarray of bool of shape (N,)
        Frames that are not free.
    length : int
        At least 1.

    Returns
    -------
    ndarray of int, ascending
    """
    width = length + 2
    counts = np.concatenate([[0], np.cumsum(blocked)])
    return np.flatnonzero(counts[width:] == counts[:-width]) + 1


def distances(hidden: Mask) -> Array:
    """Return how many frames each entry (N, D) is from the nearest other visible one.

    It is infinite where no other entry of the channel is visible.
    """
    frames = np.arange(len(hidden), dtype=np.float64)[:, None]
    nowhere = np.full((1, hidden.shape[1]), np.inf)
    last = np.maximum.accumulate(np.where(hidden, -np.inf, frames))
    following = np.minimum.accumulate(np.where(hidden, np.inf, frames)[::-1])[::-1]
    before, after = np.vstack([-nowhere, last[:-1]]), np.vstack([following[1:], nowhere])
    return np.asarray(np.minimum(frames - before, after - frames))


def frames_alike(mask: Mask) -> Iterator[tuple[Index, Mask]]:
    """Yield the frames that have one row of a mask (N, D), with that row (D,)."""
    rows, which = np.unique(mask, axis=0, return_inverse=True)
    for number, row in enumerate(rows):
        yield np.flatnonzero(which.ravel() == number), row  # NumPy 2.0 returned a column


def hidden_together(hidden: Mask) -> Iterator[Index]:
    """Yield the channels that are hidden at the same frames, those without a gap left out."""
    _, group = np.unique(hidden, axis=1, return_inverse=True)
    for number in range(int(group.max(initial=-1)) + 1):
        columns = np.flatnonzero(group.ravel() == number)
        if hidden[:, columns[0]].any():
            yield columns


def whole_gaps(hidden: Mask) -> list[Index]:
    """Return the gaps that most channels have in common, and that all are hidden in: their frames.

    In few channels that are hidden here and there, frames in which all are hidden by chance are no
    such gap. Channels that are hidden throughout do not count.
    """
    hidden = hidden[:, ~hidden.all(axis=0)]
    if not hidden.shape[1]:
        return []
    beside = np.pad(hidden, ((1, 1), (0, 0)))
    whole = runs(np.asarray(hidden.all(axis=1)))
    return [gap for gap in whole if np.mean(~(beside[gap[0]] | beside[gap[-1] + 2])) > 0.5]
