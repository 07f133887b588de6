"""Checks of an imputation, and means and variances over its hidden entries."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.metrics.base import Score
from mocapbench.metrics.outcomes.imputation import Imputation

__all__ = [
    "DEGENERATE",
    "average",
    "deviations",
    "hidden_entries",
    "mean_over",
    "variance_over",
]

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

DEGENERATE = 1e-12
"""An output whose variance is below this is left out of metrics that divide by it."""


def hidden_entries(outcome: Imputation) -> Mask:
    """Return the mask (N, D) of the entries to score, after checking the outcome.

    Raises
    ------
    ValueError
        If shapes disagree, nothing is hidden, or a hidden entry has no finite truth or mean.
    """
    shape, hidden = outcome.truth.shape, outcome.hidden
    if len(shape) != 2:
        raise ValueError(f"expected truth of shape (frames, outputs), got {shape}")
    _check_shapes(outcome)
    if not hidden.any():
        raise ValueError("expected at least one hidden entry to score, got none: hide some")
    for name, values in (("truth", outcome.truth), ("mean", outcome.mean)):
        if (wrong := hidden & ~np.isfinite(values)).any():
            bad = int(wrong.sum())
            raise ValueError(f"expected a finite {name} at hidden entries, got {bad} that are not")
    return hidden


def _check_shapes(outcome: Imputation) -> None:
    shape = outcome.truth.shape
    if len(outcome.units) not in (0, shape[1]):
        raise ValueError(
            f"expected no units or one for each of {shape[1]} outputs, got {outcome.units!r}"
        )
    for name, array, expected in (
        ("mean", outcome.mean, shape),
        ("variance", outcome.variance, shape),
        ("hidden", outcome.hidden, shape),
        ("visible_mean", outcome.visible_mean, shape[1:]),
        ("visible_variance", outcome.visible_variance, shape[1:]),
        ("scales", outcome.scales, shape[1:]),
    ):
        if array is not None and array.shape != expected:
            raise ValueError(
                f"expected {name} of shape {expected} to match truth of shape {shape}, "
                f"got {array.shape}"
            )


def deviations(outcome: Imputation) -> Array:
    """Return the predictive standard deviations (N, D), 1 at visible entries.

    Raises
    ------
    ValueError
        If the outcome has no variance, or one that is not positive and finite where hidden.
    """
    hidden = hidden_entries(outcome)
    if outcome.variance is None:
        raise ValueError("expected a predictive variance, got None: this metric needs one")
    variance = np.where(hidden, outcome.variance, 1.0)
    if not ((variance > 0) & np.isfinite(variance)).all():
        raise ValueError(
            "expected positive, finite variances at hidden entries, "
            f"got values from {variance[hidden].min():g} to {variance[hidden].max():g}"
        )
    return np.asarray(np.sqrt(variance))


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
