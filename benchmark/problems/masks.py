"""Masks: which entries of a recording are hidden."""

from __future__ import annotations

import numpy as np

from mocapbench.datasets import Mask

__all__ = ["hide_all_but", "hide_frames"]


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
