"""Means and variances over hidden entries, and predictive deviations there."""

from __future__ import annotations

import numpy as np

from mocapbench.basics.arrays import Array, Mask
from mocapbench.metrics.base import Score
from mocapbench.metrics.outcomes.imputation import Imputation

__all__ = [
    "DEGENERATE",
    "average",
    "deviations",
    "mean_over",
    "variance_over",
]


DEGENERATE = 1e-12
"""An output whose variance is below this is left out of metrics that divide by it."""


def deviations(outcome: Imputation) -> Array:
    """Return the predictive standard deviations (N, D), 1 at visible entries.

    Raises
    ------
    ValueError
        If the outcome has no variance.
    """
    if outcome.variance is None:
        raise ValueError("expected a predictive variance, got None: this metric needs one")
    return np.asarray(np.sqrt(np.where(outcome.hidden, outcome.variance, 1.0)))


def mean_over(values: Array, entries: Mask, axis: int) -> Array:
    """Return the mean of ``values`` over ``entries`` along ``axis``, NaN where there are none."""
    counts = entries.sum(axis=axis)
    totals = np.where(entries, values, 0.0).sum(axis=axis)
    return np.asarray(totals / np.where(counts > 0, counts, np.nan))


def variance_over(values: Array, entries: Mask) -> Array:
    """Return the variance (ddof 0) of each column over ``entries``, NaN where there are none."""
    return mean_over((values - mean_over(values, entries, axis=0)) ** 2, entries, axis=0)


def average(values: Array, entries: Mask, left_out: int = 0) -> Score:
    """Return the mean of ``values`` (N, D) over ``entries``, with the means per output and frame.

    The value is the mean over all entries; it equals the mean over outputs if all outputs have
    equally many. NaN if there is no entry.
    """
    parts = {
        "output": mean_over(values, entries, axis=0),
        "frame": mean_over(values, entries, axis=1),
    }
    value = float(values[entries].mean()) if entries.any() else float("nan")
    return Score(value, parts, left_out)
