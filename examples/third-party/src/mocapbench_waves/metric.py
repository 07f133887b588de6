"""The median absolute error."""

from __future__ import annotations

import numpy as np

from mocapbench.metrics import Direction, Imputation, Score, metric

__all__ = ["median_absolute_error"]


@metric(
    title="Median absolute error",
    direction=Direction.LOWER,
    sentence="Median difference of prediction and truth over all hidden entries.",
    unit="that of the data",
    range="0 to ∞",
    source="mocapbench-waves",
)
def median_absolute_error(outcome: Imputation) -> Score:
    """Return the median of |y − μ| over all hidden entries, in the output's unit."""
    errors = np.abs(outcome.truth - outcome.mean)[outcome.hidden]
    return Score(float(np.median(errors)))
