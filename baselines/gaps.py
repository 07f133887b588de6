"""Frames that are hidden as a whole, and the gaps that they make."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets import Recording

__all__ = ["hidden_frames", "runs"]


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
            f"got {partial} hidden in part; use a model that imputes any mask"
        )
    return whole


def runs(frames: NDArray[np.bool_]) -> list[NDArray[np.intp]]:
    """Return the indices of each unbroken run of True in ``frames`` (N,)."""
    index = np.flatnonzero(frames)
    breaks = np.flatnonzero(np.diff(index) > 1) + 1
    return [run for run in np.split(index, breaks) if len(run)]
