"""Whether the predictive variance tells the truth: coverage, PIT, sharpness and CRPS.

All take the predictive distribution of an observation as Gaussian, N(μ, σ²).
"""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr, ndtri

from mocapbench.metrics.base import Direction, Imputation, Metric, Score
from mocapbench.metrics.entries import average, deviations, hidden_entries

__all__ = [
    "coverage_50",
    "coverage_80",
    "coverage_90",
    "coverage_95",
    "crps",
    "gaussian_crps",
    "interval_coverage",
    "mean_deviation",
    "pit",
    "pit_distance",
    "sharpness",
]

Array = NDArray[np.float64]

_PIT_BINS = 10


def _z_scores(outcome: Imputation) -> Array:
    return np.asarray((outcome.truth - outcome.mean) / deviations(outcome))


def interval_coverage(outcome: Imputation, level: float) -> Score:
    """Return the share of hidden entries in the central interval of probability ``level``.

    That is |y − μ| ≤ z σ with z the (1 + level) / 2 quantile of the standard normal
    distribution. Parts: ``"output"``, ``"frame"``.
    """
    inside = np.abs(_z_scores(outcome)) <= ndtri((1 + level) / 2)
    return average(inside.astype(np.float64), hidden_entries(outcome))


def pit_distance(outcome: Imputation) -> Score:
    """Return the distance of the PIT histogram from uniform, ½ Σ_b |f_b − 1/10|.

    f_b is the share of hidden entries whose probability integral transform Φ((y − μ)/σ) falls in
    the b-th of ten equal bins of [0, 1]; the distance (total variation) is 0 for calibrated
    predictions in the limit of many entries and at most 0.9. Parts: ``"bin"``, the f_b.

    References
    ----------
    Gneiting, Balabdaoui and Raftery (2007), Probabilistic forecasts, calibration and sharpness,
    §3.1.
    """
    transform = ndtr(_z_scores(outcome)[hidden_entries(outcome)])
    counts, _ = np.histogram(transform, bins=_PIT_BINS, range=(0.0, 1.0))
    shares = counts / transform.size
    return Score(float(0.5 * np.abs(shares - 1 / _PIT_BINS).sum()), {"bin": shares})


def mean_deviation(outcome: Imputation) -> Score:
    """Return the mean predictive standard deviation over the hidden entries.

    Lower is sharper; it is worth having only where the coverage is right. Parts: ``"output"``,
    ``"frame"``.
    """
    return average(deviations(outcome), hidden_entries(outcome))


def gaussian_crps(outcome: Imputation) -> Score:
    """Return the mean over hidden entries of the continuous ranked probability score.

    For a Gaussian it is σ [z (2Φ(z) − 1) + 2φ(z) − 1/√π] with z = (y − μ)/σ, in the output's
    unit. Parts: ``"output"``, ``"frame"``.

    References
    ----------
    Gneiting and Raftery (2007), Strictly proper scoring rules, prediction, and estimation,
    eq. (21), with the sign that makes lower better.
    """
    z = _z_scores(outcome)
    density = np.exp(-0.5 * z**2) / np.sqrt(2 * np.pi)
    scores = deviations(outcome) * (z * (2 * ndtr(z) - 1) + 2 * density - 1 / np.sqrt(np.pi))
    return average(scores, hidden_entries(outcome))


def _coverage(percent: int) -> Metric[Imputation]:
    level = percent / 100
    return Metric(
        f"coverage_{percent}",
        f"Coverage of the {percent} % interval",
        Direction.TARGET,
        Imputation,
        partial(interval_coverage, level=level),
        needs_variance=True,
        target=level,
    )


coverage_50 = _coverage(50)
coverage_80 = _coverage(80)
coverage_90 = _coverage(90)
coverage_95 = _coverage(95)
pit = Metric(
    "pit",
    "Probability integral transform (PIT), distance from uniform",
    Direction.LOWER,
    Imputation,
    pit_distance,
    needs_variance=True,
)
sharpness = Metric(
    "sharpness",
    "Sharpness (mean predictive sd)",
    Direction.LOWER,
    Imputation,
    mean_deviation,
    needs_variance=True,
)
crps = Metric(
    "crps",
    "Continuous ranked probability score (CRPS)",
    Direction.LOWER,
    Imputation,
    gaussian_crps,
    needs_variance=True,
)
