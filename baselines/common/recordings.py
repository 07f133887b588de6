"""Recordings: their order, their frames together, complete frames, and lines across gaps."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cmp_to_key

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array, Mask
from mocapbench.basics.mask_runs import runs
from mocapbench.datasets import FrameByChannel, Frames, Recording

__all__ = [
    "by_content",
    "complete_stretches",
    "hidden_frames",
    "interpolate_channels",
    "places_by_content",
    "stack",
    "stretches",
    "visible_frames",
    "visible_means",
    "visible_moments",
    "with_steps",
]


def by_content(recordings: Sequence[Recording]) -> tuple[Recording, ...]:
    """Return recordings in an order that follows from their values and times alone.

    Models learn from them in this order, so that neither their names nor the order in which they
    are given affect results: rounding does not depend on them, nor does what is drawn at random.
    """
    return tuple(sorted(recordings, key=cmp_to_key(_compare)))


def places_by_content(recordings: Sequence[Recording]) -> NDArray[np.intp]:
    """Return the place (K,) of each of K recordings in `by_content`, their names being distinct.

    Indexed with it, an array of results in that order is in the order of ``recordings``.
    """
    places = {recording.name: place for place, recording in enumerate(by_content(recordings))}
    return np.array([places[recording.name] for recording in recordings], dtype=np.intp)


def _compare(one: Recording, other: Recording) -> int:
    """Return the sign of the first difference between recordings: of their lengths, or of a value.

    The first value that differs is less in the same one whatever the unit is.
    """
    if len(one.times) != len(other.times):
        return len(one.times) - len(other.times)
    for these, those in zip(_contents(one), _contents(other), strict=True):
        for place in np.flatnonzero(these != those)[:1]:
            return 1 if these.flat[place] > those.flat[place] else -1
    return 0


def _contents(recording: Recording) -> tuple[Array, Array]:
    """Return the values, what is hidden below all others, and the times since the first frame."""
    values = np.where(recording.visible, recording.values, -np.inf)
    return values, recording.times - recording.times[0]


def stack(recordings: Sequence[Recording]) -> FrameByChannel:
    """Return the values of all recordings, stacked along frames: (ΣN, D)."""
    values = [recording.values for recording in recordings]
    return np.concatenate(values) if len(values) > 1 else values[0]


def visible_moments(recordings: Sequence[Recording]) -> tuple[Array, Array]:
    """Return the mean and variance (ddof 0) of each channel's visible entries: (D,) each.

    They are NaN where a channel has none.
    """
    values, mean = stack(recordings), visible_means(recordings)
    variance = _average_visible((values - mean) ** 2, ~np.isnan(values))
    return mean, variance


def visible_means(recordings: Sequence[Recording]) -> Array:
    """Return the mean of each channel's visible entries (D,), NaN where it has none."""
    values = stack(recordings)
    return _average_visible(values, ~np.isnan(values))


def _average_visible(values: FrameByChannel, seen: Mask) -> Array:
    counts = np.where(seen.any(axis=0), seen.sum(axis=0), np.nan)
    return np.asarray(np.where(seen, values, 0.0).sum(axis=0) / counts)


def hidden_frames(recording: Recording) -> Mask:
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


def visible_frames(recording: Recording) -> Mask:
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


def interpolate_channels(
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
