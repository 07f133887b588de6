"""Runs of frames within one recording, of several that are one below the other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["runs_of_frames"]


def runs_of_frames(n_frames: int, starts: tuple[int, ...], width: int) -> NDArray[np.intp]:
    """Return the first frame of every run of ``width`` frames within one recording."""
    first = np.arange(max(n_frames - width + 1, 0))
    recording = np.searchsorted(starts, np.arange(n_frames), side="right")
    return np.asarray(first[recording[first] == recording[first + width - 1]])
