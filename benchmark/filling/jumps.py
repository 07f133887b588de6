"""Jumps at the edges of filled gaps, where entries do not fit the visible ones beside them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mocapbench.datasets import Mask, Recording

__all__ = ["Jump", "find_jumps"]

_RELATIVE = 1e-6
"""Steps below this share of the values of a channel's unit, if it has one, are rounding."""
_LONGER = 1.25
"""How many times as long as every visible step a jump is: the longest of few says little."""


class Jump(NamedTuple):
    """A step between a visible and a filled frame that is a quarter longer than visible ones.

    Parameters
    ----------
    frame : int
        The filled frame, 0-based.
    channel : int
    size : float
        Of the step, in the channel's unit.
    largest : float
        Of the steps between visible frames of the channel.
    """

    frame: int
    channel: int
    size: float
    largest: float


def find_jumps(recording: Recording, target: Mask) -> list[Jump]:
    """Return the jumps of a filled recording, the one that exceeds visible steps most first.

    A step is |x(n + 1) − x(n)| of a channel x with frames n. A channel without two visible frames
    in a row has no steps to compare with, and no jumps.

    Parameters
    ----------
    recording : Recording
        N frames of D channels, filled.
    target : ndarray of bool of shape (N, D)
        The entries that were filled.
    """
    steps = np.abs(np.diff(recording.values, axis=0))
    visible = recording.visible & ~target
    within = visible[1:] & visible[:-1]
    largest = np.where(within, steps, 0.0).max(axis=0, initial=0.0)
    alike = np.array(
        [unit or name for unit, name in zip(recording.units, recording.channels, strict=True)]
    )
    sizes = np.where(visible, np.abs(recording.values), 0.0).max(axis=0, initial=0.0)
    least = _RELATIVE * np.array([sizes[alike == one].max() for one in alike])
    edges = (target[1:] & visible[:-1]) | (visible[1:] & target[:-1])
    found = edges & within.any(axis=0) & (steps > _LONGER * largest + least)
    return sorted(
        (
            Jump(int(n + target[n + 1, c]), int(c), float(steps[n, c]), float(largest[c]))
            for n, c in zip(*np.nonzero(found), strict=True)
        ),
        key=lambda jump: (jump.largest / jump.size, jump.frame, jump.channel),
    )
