"""The likelihood of the hidden entries under the prediction."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.metrics.base import Direction, Imputation, Metric, Score
from mocapbench.metrics.entries import DEGENERATE, average, deviations, hidden_entries

__all__ = ["mean_standardised_log_loss", "msll"]

Array = NDArray[np.float64]


def _log_loss(values: Array, mean: Array, variance: Array) -> Array:
    """Return −log N(values; mean, variance)."""
    return np.asarray(0.5 * np.log(2 * np.pi * variance) + (values - mean) ** 2 / (2 * variance))


def mean_standardised_log_loss(outcome: Imputation) -> Score:
    """Return the mean over hidden entries of the log loss, less that of the trivial Gaussian.

    The loss of an entry is ½ log(2πσ²) + (y − μ)² / (2σ²), with σ² the predictive variance of an
    observation, noise included. The trivial Gaussian has the mean and the variance (ddof 0) of
    the output's visible entries: predicting it scores 0, and less is better. Outputs whose
    visible variance is below 1e-12 are left out; NaN if all are. Parts: ``"output"``,
    ``"frame"``.

    References
    ----------
    Rasmussen and Williams (2006), Gaussian Processes for Machine Learning, §2.5.
    """
    variance = deviations(outcome) ** 2
    kept = outcome.visible_variance >= DEGENERATE
    trivial_variance = np.where(kept, outcome.visible_variance, 1.0)
    loss = _log_loss(outcome.truth, outcome.mean, variance)
    trivial = _log_loss(outcome.truth, outcome.visible_mean, trivial_variance)
    hidden = hidden_entries(outcome)
    left_out = int((hidden.any(axis=0) & ~kept).sum())
    return average(loss - trivial, hidden & kept, left_out)


msll = Metric(
    "msll",
    "Mean standardised log loss (MSLL)",
    Direction.LOWER,
    Imputation,
    mean_standardised_log_loss,
    needs_variance=True,
)
