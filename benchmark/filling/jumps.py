"""Jumps at the edges of filled gaps, where entries do not fit the visible ones beside them."""

from __future__ import annotations

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Mask, Recording

__all__ = ["find_jumps", "measure_edges"]

_RELATIVE = 1e-6
"""Steps below this share of the values of a channel's unit, if it has one, are rounding."""
_BLOCK = 4096
"""Frames whose steps are computed at once, so that long recordings take no more memory."""
_LONGER = 1.25
"""How many times as long as every visible step a jump is: the longest of few says little."""


def find_jumps(recording: Recording, target: Mask) -> pd.DataFrame:
    """Return the jumps of a filled recording, the one that exceeds visible steps most first.

    A jump is a step between a visible and a filled frame that is a quarter longer than visible
    ones, see `measure_edges`.
    """
    edges = measure_edges(recording, target)
    return edges[edges["jumps"]].drop(columns=["relative", "jumps"]).reset_index(drop=True)


def measure_edges(recording: Recording, target: Mask) -> pd.DataFrame:
    """Return the steps at the edges of filled gaps, that which exceeds visible ones most first.

    A step is |x(n + 1) − x(n)| of a channel x with frames n. A channel without two visible frames
    in a row has no steps to compare with, and is left out.

    Parameters
    ----------
    recording : Recording
        N frames of D channels, filled.
    target : ndarray of bool of shape (N, D)
        The entries that were filled.

    Returns
    -------
    DataFrame
        A row a step between a visible and a filled frame, with the filled ``frame`` (0-based), the
        ``channel`` (an index), the ``size`` of the step, the ``largest`` of the steps between
        visible frames of the channel, both in its unit, ``relative``, the size by the largest, or
        by rounding where the channel stands still, and whether it ``jumps``.
    """
    values, visible = recording.values, recording.visible & ~target
    within = visible[1:] & visible[:-1]
    largest = _find_largest_steps(values, within)
    is_edge = (target[1:] & visible[:-1]) | (visible[1:] & target[:-1])
    rounding = _find_rounding(recording, visible)
    n, c = np.nonzero(is_edge & within.any(axis=0))
    size, scale = np.abs(values[n + 1, c] - values[n, c]), np.maximum(largest, rounding)[c]
    edges = {
        "frame": n + target[n + 1, c],
        "channel": c,
        "size": size,
        "largest": largest[c],
        "relative": np.divide(
            size, scale, out=np.where(size > 0.0, np.inf, 0.0), where=scale > 0.0
        ),
        "jumps": size > (_LONGER * largest + rounding)[c],
    }
    with np.errstate(divide="ignore", invalid="ignore"):
        order = np.lexsort((c, edges["frame"], largest[c] / size))
    return pd.DataFrame(edges).iloc[order].reset_index(drop=True)


def _find_largest_steps(values: FrameByChannel, within: Mask) -> Array:
    """Return the largest of the steps of each channel (D,) where ``within``, 0 if there is none."""
    largest = np.zeros(values.shape[1])
    for at in range(0, len(within), _BLOCK):
        steps = np.abs(np.diff(values[at : at + _BLOCK + 1], axis=0))
        most = steps.max(axis=0, initial=0.0, where=within[at : at + _BLOCK])
        largest = np.maximum(largest, most)
    return largest


def _find_rounding(recording: Recording, visible: Mask) -> Array:
    """Return the step (D,) below which a channel does not move but for rounding."""
    alike = np.array(
        [unit or name for unit, name in zip(recording.units, recording.channels, strict=True)]
    )
    least = recording.values.min(axis=0, initial=0.0, where=visible)
    sizes = np.maximum(recording.values.max(axis=0, initial=0.0, where=visible), -least)
    return _RELATIVE * np.array([sizes[alike == one].max() for one in alike])
