"""Jumps at the edges of filled gaps, where entries do not fit the visible ones beside them."""

from __future__ import annotations

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Array
from mocapbench.datasets import Mask, Recording

__all__ = ["find_jumps"]

_RELATIVE = 1e-6
"""Steps below this share of the values of a channel's unit, if it has one, are rounding."""
_LONGER = 1.25
"""How many times as long as every visible step a jump is: the longest of few says little."""


def find_jumps(recording: Recording, target: Mask) -> pd.DataFrame:
    """Return the jumps of a filled recording, the one that exceeds visible steps most first.

    A jump is a step between a visible and a filled frame that is a quarter longer than visible
    ones. A step is |x(n + 1) − x(n)| of a channel x with frames n. A channel without two visible
    frames in a row has no steps to compare with, and no jumps.

    Parameters
    ----------
    recording : Recording
        N frames of D channels, filled.
    target : ndarray of bool of shape (N, D)
        The entries that were filled.

    Returns
    -------
    DataFrame
        A row a jump, with the filled ``frame`` (0-based), the ``channel`` (an index), the ``size``
        of the step, and the ``largest`` of the steps between visible frames of the channel, both
        in its unit.
    """
    steps = np.abs(np.diff(recording.values, axis=0))
    visible = recording.visible & ~target
    within = visible[1:] & visible[:-1]
    largest = np.where(within, steps, 0.0).max(axis=0, initial=0.0)
    edges = (target[1:] & visible[:-1]) | (visible[1:] & target[:-1])
    longer = steps > _LONGER * largest + _find_rounding(recording, visible)
    n, c = np.nonzero(edges & within.any(axis=0) & longer)
    jumps = {
        "frame": n + target[n + 1, c],
        "channel": c,
        "size": steps[n, c],
        "largest": largest[c],
    }
    order = np.lexsort((c, jumps["frame"], largest[c] / steps[n, c]))
    return pd.DataFrame(jumps).iloc[order].reset_index(drop=True)


def _find_rounding(recording: Recording, visible: Mask) -> Array:
    """Return the step (D,) below which a channel does not move but for rounding."""
    alike = np.array(
        [unit or name for unit, name in zip(recording.units, recording.channels, strict=True)]
    )
    sizes = np.where(visible, np.abs(recording.values), 0.0).max(axis=0, initial=0.0)
    return _RELATIVE * np.array([sizes[alike == one].max() for one in alike])
