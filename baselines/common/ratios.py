"""By how much squared errors exceed the variances that a model claims, channel by channel."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["mean_ratios"]

Array = NDArray[np.float64]

_PRIOR_ENTRIES = 10
"""Entries that count in each channel as having the mean ratio over all channels."""


def mean_ratios(sums: Array, counts: Array) -> Array:
    """Return the mean ratio of squared errors to claimed variances in each channel, (D,).

    Parameters
    ----------
    sums : ndarray of shape (D,)
        Of the ratios of a channel's entries.
    counts : ndarray of shape (D,)
        The numbers of these entries, not all of them 0.
    """
    pooled = float(sums.sum() / counts.sum())
    return np.asarray((sums + _PRIOR_ENTRIES * pooled) / (counts + _PRIOR_ENTRIES))
