"""Whether sampled recordings resemble reference recordings, and vary as they do."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from mocapbench.metrics.base import Direction, Metric, Score, Synthesis
from mocapbench.metrics.correlation import (
    SampleByReferenceByOutput,
    check_synthesis,
    cross_correlation,
    linear_correlation,
)

__all__ = [
    "Correlation",
    "best_similarity",
    "marginal_variance_ratio",
    "mcc",
    "mcc_best",
    "mean_similarity",
    "mlc",
    "mlc_best",
    "variance_ratio",
]

Array = NDArray[np.float64]
Correlation = Callable[[Synthesis], SampleByReferenceByOutput]


def mean_similarity(outcome: Synthesis, correlation: Correlation) -> Score:
    """Return the mean correlation over samples, references and outputs.

    An output that is constant in any sample or reference is left out; NaN if all are. Parts:
    ``"output"`` (D,), ``"sample"`` (S,) and ``"reference"`` (M,), the means over the other axes,
    and ``"reference_sd"`` (M,), the standard deviation (ddof 1) over samples that the thesis's
    mean ± 2 sd speaks of, NaN for a single sample.

    References
    ----------
    Thesis §4.3.
    """
    values = correlation(outcome)
    pairs, left_out = _over_outputs(values)
    parts = {
        "output": values.mean(axis=(0, 1)),
        "sample": pairs.mean(axis=1),
        "reference": pairs.mean(axis=0),
        "reference_sd": _deviation(pairs),
    }
    return Score(float(pairs.mean()), parts, left_out)


def best_similarity(outcome: Synthesis, correlation: Correlation) -> Score:
    """Return the mean correlation with the best-matched reference.

    Of the references' means over samples and outputs, the greatest: one reference for all
    samples. NaN where there is but one, and nothing to choose from. Outputs are left out as in
    `mean_similarity`. Parts: ``"sample"`` (S,), the correlation of each sample with that
    reference.

    References
    ----------
    Thesis §A.4.2.
    """
    pairs, left_out = _over_outputs(correlation(outcome))
    if pairs.shape[1] == 1:
        return Score(np.nan, {"sample": np.full(len(pairs), np.nan)}, left_out)
    best = pairs[:, pairs.mean(axis=0).argmax()]
    return Score(float(best.mean()), {"sample": best}, left_out)


def _over_outputs(values: SampleByReferenceByOutput) -> tuple[Array, int]:
    """Return the means (S, M) over the outputs that are not NaN, and the count of the others."""
    kept = ~np.isnan(values).any(axis=(0, 1))
    pairs = values[:, :, kept].sum(axis=2) / (kept.sum() or np.nan)
    return np.asarray(pairs), int((~kept).sum())


def _deviation(pairs: Array) -> Array:
    if len(pairs) == 1:
        return np.full(pairs.shape[1], np.nan)
    return np.asarray(pairs.std(axis=0, ddof=1))


def marginal_variance_ratio(outcome: Synthesis) -> Score:
    """Return the mean marginal variance of the samples over that of the references.

    The variance (ddof 1) is taken over sequences at each frame of each output, around the
    sequences' own mean there, and averaged over frames and outputs before the division. 1 is
    right; a sampler that collapses to its trend has 0. Fewer than two samples or references have
    no variance, and the ratio is NaN.

    Raises
    ------
    ValueError
        If the references do not vary.
    """
    check_synthesis(outcome)
    if min(len(outcome.samples), len(outcome.references)) < 2:
        return Score(np.nan)
    of_references = outcome.references.var(axis=0, ddof=1).mean()
    if of_references == 0:
        raise ValueError("variance_ratio: expected references that differ, got equal ones")
    return Score(float(outcome.samples.var(axis=0, ddof=1).mean() / of_references))


def _mean(name: str, title: str, correlation: Correlation) -> Metric[Synthesis]:
    statistic = partial(mean_similarity, correlation=correlation)
    return Metric(name, title, Direction.HIGHER, Synthesis, statistic)


def _best(name: str, title: str, correlation: Correlation) -> Metric[Synthesis]:
    statistic = partial(best_similarity, correlation=correlation)
    return Metric(name, title, Direction.HIGHER, Synthesis, statistic)


mcc = _mean("mcc", "Maximum cross-correlation (MCC)", cross_correlation)
mlc = _mean("mlc", "Mean linear correlation (MLC)", linear_correlation)
mcc_best = _best("mcc_best", "Maximum cross-correlation, best match", cross_correlation)
mlc_best = _best("mlc_best", "Mean linear correlation, best match", linear_correlation)
variance_ratio = Metric(
    "variance_ratio",
    "Variance ratio",
    Direction.TARGET,
    Synthesis,
    marginal_variance_ratio,
    target=1.0,
    former_names=("spread",),
)
