"""Frames that are hidden as a whole, channels hidden together, runs of frames, and lines across."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets import FrameByChannel, Frames, Mask, Recording

__all__ = [
    "complete_stretches",
    "distances",
    "frames_alike",
    "hidden_frames",
    "hidden_together",
    "interpolated",
    "runs",
    "stretches",
    "visible_frames",
    "whole_gaps",
    "with_steps",
]


def hidden_frames(recording: Recording) -> NDArray[np.bool_]:
    """Return which frames (N,) are hidden as a whole.

    Raises
    ------
    ValueError
        If a frame is hidden in part.
    """
    hidden = np.isnan(recording.values)
    whole = np.asarray(hidden.all(axis=1))
    partial = int((hidden.any(axis=1) & ~whole).sum())
    if partial:
        raise ValueError(
            f"recording {recording.name!r}: expected frames all visible or all hidden, "
            f"got {partial} hidden in part; use a model that fills any gaps"
        )
    return whole


def visible_frames(recording: Recording) -> NDArray[np.bool_]:
    """Return which frames (N,) are visible.

    Raises
    ------
    ValueError
        If a frame is hidden in part, or none is visible.
    """
    visible = ~hidden_frames(recording)
    if not visible.any():
        raise ValueError(f"recording {recording.name!r}: expected a visible frame, got none")
    return visible


def frames_alike(mask: Mask) -> Iterator[tuple[NDArray[np.intp], NDArray[np.bool_]]]:
    """Yield the frames that have one row of a mask (N, D), with that row (D,)."""
    rows, which = np.unique(mask, axis=0, return_inverse=True)
    for number, row in enumerate(rows):
        yield np.flatnonzero(which.ravel() == number), row  # NumPy 2.0 returned a column


def hidden_together(hidden: Mask) -> Iterator[NDArray[np.intp]]:
    """Yield the channels that are hidden at the same frames, those without a gap left out."""
    _, group = np.unique(hidden, axis=1, return_inverse=True)
    for number in range(int(group.max(initial=-1)) + 1):
        columns = np.flatnonzero(group.ravel() == number)
        if hidden[:, columns[0]].any():
            yield columns


def runs(frames: NDArray[np.bool_]) -> list[NDArray[np.intp]]:
    """Return the indices of each unbroken run of True in ``frames`` (N,)."""
    index = np.flatnonzero(frames)
    breaks = np.flatnonzero(np.diff(index) > 1) + 1
    return [run for run in np.split(index, breaks) if len(run)]


def distances(hidden: Mask) -> FrameByChannel:
    """Return how many frames each entry (N, D) is from the nearest other visible one.

    It is infinite where no other entry of the channel is visible.
    """
    frames = np.arange(len(hidden), dtype=np.float64)[:, None]
    nowhere = np.full((1, hidden.shape[1]), np.inf)
    last = np.maximum.accumulate(np.where(hidden, -np.inf, frames))
    following = np.minimum.accumulate(np.where(hidden, np.inf, frames)[::-1])[::-1]
    before, after = np.vstack([-nowhere, last[:-1]]), np.vstack([following[1:], nowhere])
    return np.asarray(np.minimum(frames - before, after - frames))


def whole_gaps(hidden: Mask) -> list[NDArray[np.intp]]:
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


def stretches(recording: Recording) -> list[FrameByChannel]:
    """Return each unbroken run of complete frames (N, D) of a recording."""
    complete = np.asarray(recording.visible.all(axis=1))
    return [recording.values[run] for run in runs(complete)]


def complete_stretches(recordings: Sequence[Recording]) -> list[FrameByChannel]:
    """Return the `stretches` of recordings, one after the other.

    Raises
    ------
    ValueError
        If no two consecutive frames are complete.
    """
    with_steps(recordings)
    return [stretch for recording in recordings for stretch in stretches(recording)]


def with_steps(recordings: Sequence[Recording]) -> list[Recording]:
    """Return the recordings in which two consecutive frames are complete.

    Raises
    ------
    ValueError
        If there is none.
    """
    usable = [one for one in recordings if any(len(each) > 1 for each in stretches(one))]
    if not usable:
        raise ValueError(
            "expected two consecutive frames of some recording that are visible in all channels, "
            "got none; add such a recording, or use a model that learns from any visible entries"
        )
    return usable


def interpolated(
    values: FrameByChannel, times: Frames, wanted: Frames | None = None
) -> FrameByChannel:
    """Return channels on lines between their visible entries, held at the ends: (M, D).

    A channel without any is NaN.

    Parameters
    ----------
    values : ndarray of shape (N, D)
        NaN where hidden.
    times : ndarray of shape (N,)
    wanted : ndarray of shape (M,), optional
        The times to return, those of ``values`` by default.
    """
    at = times if wanted is None else wanted
    read = np.full((len(at), values.shape[1]), np.nan)
    for column, given in zip(read.T, values.T, strict=True):
        seen = ~np.isnan(given)
        if seen.any():
            column[:] = np.interp(at, times[seen], given[seen])
    return read
