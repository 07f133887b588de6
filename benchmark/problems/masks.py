"""Masks: which entries of a recording are hidden."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from mocapbench.datasets import Mask, Recording

__all__ = ["hide_all_but", "hide_frames", "hide_runs"]


def hide_all_but(rng: np.random.Generator, n_visible: int, n_frames: int, n_channels: int) -> Mask:
    """Return a mask that leaves ``n_visible`` random frames of each channel visible.

    The frames are drawn without replacement, anew for every channel.

    Returns
    -------
    ndarray of bool, shape (n_frames, n_channels)
        True where hidden.
    """
    order = rng.permuted(np.tile(np.arange(n_frames), (n_channels, 1)), axis=1)
    return (order >= n_visible).T


def hide_frames(start: int, stop: int, n_frames: int, n_channels: int) -> Mask:
    """Return a mask of whole frames: those in [start, stop), 0-based, are hidden."""
    frames = np.arange(n_frames)
    hidden = (frames >= start) & (frames < stop)
    return np.repeat(hidden[:, None], n_channels, axis=1)


def hide_runs(runs: Iterable[tuple[Sequence[str], int, int]], recording: Recording) -> Mask:
    """Return a mask (N, D) of runs of frames, each in some channels.

    Parameters
    ----------
    runs : iterable of tuple
        Of each its channels, its first frame, counted from 0, and how many frames it has.
    recording : Recording

    Raises
    ------
    ValueError
        If a run does not lie within the recording, or one of its channels is not in it.
    """
    hidden = np.zeros(recording.values.shape, dtype=bool)
    for channels, start, length in runs:
        stop, n_frames = start + length, len(hidden)
        missing = sorted({*channels} - {*recording.channels})
        if missing or not 0 <= start < stop <= n_frames:
            raise ValueError(
                f"recording {recording.name!r}: expected a run of its channels within its "
                f"{n_frames} frames, got frames [{start}, {stop}) and unknown channels "
                f"{missing}"
            )
        columns = [recording.channels.index(channel) for channel in channels]
        hidden[start:stop, columns] = True
    return hidden
