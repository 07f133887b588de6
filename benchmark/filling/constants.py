"""Channels that are constant wherever they are visible, and stay so where they are filled.

The height of a point on the floor, or an angle that a skeleton does not use, does not move in a gap
either, whatever a model makes of it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.filling.question import FilledEntries, GapQuestion

__all__ = ["keep_constants"]


_ENOUGH = 10
"""Frames; fewer that are equal are so by chance in files of rounded numbers, unless most are."""


def keep_constants(question: GapQuestion, filled: FilledEntries) -> FilledEntries:
    """Return the filled entries, those of a channel that is constant where visible as constant.

    Their variances stay those of the model.
    """
    _, channels = np.nonzero(question.target)
    kept = _constants(question)[channels]
    return replace(filled, mean=np.where(np.isnan(kept), filled.mean, kept))


def _constants(question: GapQuestion) -> Array:
    """Return the one value of each channel (D,) in all recordings, NaN where it has others."""
    values = [recording.values for recording in (question.given, *question.train)]
    highest = np.fmax.reduce([np.fmax.reduce(one, axis=0) for one in values])  # ignores NaN
    lowest = np.fmin.reduce([np.fmin.reduce(one, axis=0) for one in values])
    seen = question.given.visible.sum(axis=0)
    enough = seen >= np.clip(len(question.given.times) - seen, 2, _ENOUGH)
    return np.where(enough & (highest == lowest), highest, np.nan)
