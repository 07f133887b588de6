"""What the visible entries of a recording say of its variances, each predicted from all others.

Maximum likelihood makes variances right on average over all recordings. One of them may be less
like the others than the rest are, and a plug-in process leaves out the doubt about its parameters.
"""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.calibration.error_ratios import mean_ratios
from mocapbench.baselines.calibration.variance_check import STEEPEST
from mocapbench.basics.arrays import Array
from mocapbench.basics.mask_runs import distances
from mocapbench.datasets import Mask

__all__ = ["leave_one_out_factors"]

_NOMINAL = 200
"""Entries of ratio 1 that count besides, before variances become smaller."""


def leave_one_out_factors(visible: Mask, ratios: Array) -> Array:
    """Return what the predicted variances of each channel are to be multiplied by: (D,).

    The mean ratio of the channel, in which the mean over all channels counts as ten entries
    (`mean_ratios`), but never less than what all entries together support.

    Parameters
    ----------
    visible : ndarray of bool, shape (N, D)
        Of the recording.
    ratios : ndarray of shape (N, D)
        The squared error over the variance of each entry that is left out; NaN where it is not
        known.
    """
    counts = np.isfinite(ratios).sum(axis=0)
    if not counts.any():
        return np.ones(len(counts))
    return np.maximum(mean_ratios(np.nansum(ratios, axis=0), counts), _least(visible, ratios))


def _least(visible: Mask, ratios: Array) -> Array:
    """Return the least factors (D,) that all entries support, at most 1.

    200 entries of ratio 1 count besides. Where the gaps of a channel lie farther from what is
    visible than visible entries do from each other, the ratio is taken to grow as steeply as
    held-out gaps ever let it; where nothing else of a channel is visible, it says nothing.
    """
    left_out = np.isfinite(ratios)
    ratio = (np.nansum(ratios) + _NOMINAL) / (left_out.sum() + _NOMINAL)
    there, here = _mean_distances(visible, ~visible), _mean_distances(visible, visible)
    known = np.isfinite(there) & np.isfinite(here)
    farther = np.divide(there, here, out=np.full(len(here), np.inf), where=known)
    return np.asarray(np.minimum(ratio * np.maximum(farther, 1.0) ** STEEPEST, 1.0))


def _mean_distances(visible: Mask, entries: Mask) -> Array:
    """Return the mean number of frames from ``entries`` to the nearest other visible ones: (D,).

    It is infinite in channels where an entry has none, and 0 where there is no entry.
    """
    total = distances(~visible).sum(axis=0, where=entries)
    return np.asarray(total / np.maximum(entries.sum(axis=0), 1))
