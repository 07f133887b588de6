"""By how much squared errors exceed the predicted variances, channel by channel."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.protocols import Prediction
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Mask, Recording

__all__ = ["LEAST", "geometric_ratios", "mean_ratios", "sum_ratios"]


LEAST = 0.01
"""The least factor: where nothing varies, errors are 0, and variances would vanish."""

_TINY = np.finfo(np.float64).tiny
_PRIOR_ENTRIES = 10
"""Entries that count in each channel as having the mean ratio over all channels."""


def mean_ratios(sums: Array, counts: Array) -> Array:
    """Return the mean ratio of squared errors to predicted variances in each channel, (D,).

    Parameters
    ----------
    sums : ndarray of shape (D,)
        Of the ratios of a channel's entries.
    counts : ndarray of shape (D,)
        The numbers of these entries, not all of them 0.
    """
    pooled = float(sums.sum() / counts.sum())
    return np.asarray((sums + _PRIOR_ENTRIES * pooled) / (counts + _PRIOR_ENTRIES))


def geometric_ratios(sums: Array, counts: Array) -> Array:
    """Return the ratio in each channel, moved towards that of all channels by its logarithm, (D,).

    Unlike `mean_ratios` it can be far below the ratio of all: where the variances of one channel
    are much too large and those of others are not, their mean is that of the others.
    """
    pooled = np.log(sums.sum() / counts.sum() + _TINY)
    own = np.log(sums / np.maximum(counts, 1) + _TINY)
    return np.asarray(np.exp((counts * own + _PRIOR_ENTRIES * pooled) / (counts + _PRIOR_ENTRIES)))


def sum_ratios(truth: Recording, mask: Mask, prediction: Prediction) -> Array:
    """Return the sums of squared errors over predicted variances, and their numbers: (2, D).

    Parameters
    ----------
    truth : Recording
        With D channels.
    mask : ndarray of shape (N, D)
        The entries that count; those that are hidden in ``truth`` do not.
    prediction : Prediction
        Without variances it says nothing.
    """
    known = mask & truth.visible & (prediction.variance is not None)
    variance = np.where(known, np.asarray(prediction.variance, dtype=np.float64), 1.0)
    errors = np.where(known, truth.values - prediction.mean, 0.0)
    return np.stack([(errors**2 / variance).sum(axis=0), known.sum(axis=0)])
