"""The median absolute error."""

from __future__ import annotations

import numpy as np

from mocapbench.metrics import Direction, Imputation, Metric, Score

__all__ = ["median_absolute_error", "median_of_errors"]


def median_of_errors(outcome: Imputation) -> Score:
    """Return the median of |y − μ| over all hidden entries, in the output's unit."""
    errors = np.abs(outcome.truth - outcome.mean)[outcome.hidden]
    return Score(float(np.median(errors)))


median_absolute_error = Metric(
    "median_absolute_error",
    "Median absolute error",
    Direction.LOWER,
    Imputation,
    median_of_errors,
    sentence="Median difference of prediction and truth over all hidden entries.",
    unit="that of the data",
    range="0 to ∞",
    source="mocapbench-waves",
)
