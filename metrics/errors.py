"""Errors of the predicted mean at the hidden entries."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.metrics.base import Direction, Imputation, Metric, Score
from mocapbench.metrics.entries import (
    DEGENERATE,
    average,
    hidden_entries,
    mean_over,
    variance_over,
)

__all__ = [
    "mean_squared_error",
    "mse",
    "pooled_standardised_error",
    "rms_error_per_frame",
    "rms_per_frame",
    "smse",
    "smse_pooled",
    "standardised_error",
]

Array = NDArray[np.float64]


def _squared_error(outcome: Imputation) -> Array:
    return np.asarray((outcome.truth - outcome.mean) ** 2)


def mean_squared_error(outcome: Imputation) -> Score:
    """Return the mean of (y − μ)² over the hidden entries.

    Parts: ``"output"`` and ``"frame"``, the mean over the hidden entries of each.
    """
    return average(_squared_error(outcome), hidden_entries(outcome))


def standardised_error(outcome: Imputation) -> Score:
    """Return the mean over outputs of MSE_d / var_d.

    MSE_d is the mean of (y − μ)² over the hidden entries of output d and var_d the variance
    (ddof 0) of its hidden truth: 1 for the mean of what is to be predicted. Outputs whose visible
    or hidden variance is below 1e-12 are left out; NaN if all are. Parts: ``"output"``.

    References
    ----------
    Rasmussen and Williams (2006), Gaussian Processes for Machine Learning, §2.5.
    """
    hidden = hidden_entries(outcome)
    variance = variance_over(outcome.truth, hidden)
    kept = (outcome.visible_variance >= DEGENERATE) & (variance >= DEGENERATE)
    errors = mean_over(_squared_error(outcome), hidden & kept, axis=0)
    ratios = errors / np.where(kept, variance, 1.0)
    value = float(ratios[kept].mean()) if kept.any() else float("nan")
    return Score(value, {"output": ratios}, int((hidden.any(axis=0) & ~kept).sum()))


def pooled_standardised_error(outcome: Imputation) -> Score:
    """Return MSE / var, both over the hidden entries of all outputs together.

    One variance (ddof 0) around one mean: the ratio that the thesis tabulates as SMSE, as its
    MSE columns show. Outputs whose visible variance is below 1e-12 are left out; NaN if no
    variance remains. Parts: ``"output"`` and ``"frame"``, MSE over the same pooled variance.
    """
    hidden = hidden_entries(outcome)
    kept = outcome.visible_variance >= DEGENERATE
    scored = hidden & kept
    variance = outcome.truth[scored].var() if scored.any() else 0.0
    scale = variance if variance >= DEGENERATE else np.nan
    left_out = int((hidden.any(axis=0) & ~kept).sum())
    return average(_squared_error(outcome) / scale, scored, left_out)


def rms_error_per_frame(outcome: Imputation) -> Score:
    """Return the mean over hidden frames of ‖y_t − μ_t‖, the norm over the frame's hidden entries.

    A frame counts if any of its entries is hidden. Parts: ``"frame"``.

    References
    ----------
    Wang, Fleet and Hertzmann (2008), Gaussian process dynamical models for human motion, Table 2,
    whose "RMS error per frame" is this mean norm and not the root of a mean square.
    """
    hidden = hidden_entries(outcome)
    norms = np.sqrt(np.where(hidden, _squared_error(outcome), 0.0).sum(axis=1))
    frames = np.where(hidden.any(axis=1), norms, np.nan)
    return Score(float(np.nanmean(frames)), {"frame": frames})


mse = Metric("mse", "Mean squared error (MSE)", Direction.LOWER, Imputation, mean_squared_error)
smse = Metric(
    "smse",
    "Standardised MSE (SMSE)",
    Direction.LOWER,
    Imputation,
    standardised_error,
)
smse_pooled = Metric(
    "smse_pooled",
    "Standardised MSE, pooled (SMSE)",
    Direction.LOWER,
    Imputation,
    pooled_standardised_error,
)
rms_per_frame = Metric(
    "rms_per_frame", "RMS error per frame", Direction.LOWER, Imputation, rms_error_per_frame
)
