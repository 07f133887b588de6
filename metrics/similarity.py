"""Resemblance of sampled to reference recordings, and how much the samples vary."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
from numpy.typing import NDArray

from mocapbench.metrics.base import Direction, Metric, Score
from mocapbench.metrics.correlation import (
    SampleByReferenceByOutput,
    check_synthesis,
    cross_correlation,
    linear_correlation,
)
from mocapbench.metrics.outcomes.synthesis import Synthesis

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
    r"""Return the mean correlation over samples, references and outputs.

    The metrics ``mcc`` (maximum cross-correlation; the thesis calls it mean cross correlation) and
    ``mlc`` (mean linear correlation). Higher is better; without unit. An output that is constant in
    any sample or reference is left out.

    Parameters
    ----------
    outcome : Synthesis
        With S samples and M references of D outputs over N frames.
    correlation : callable
        ``cross_correlation`` (MCC) or ``linear_correlation`` (MLC).

    Returns
    -------
    Score
        NaN if all outputs are left out. With parts ``"output"`` (D,), ``"sample"`` (S,) and
        ``"reference"`` (M,), the means over the other axes, and ``"reference_sd"`` (M,), the
        standard deviation (ddof 1) over samples, of which the thesis gives mean ± 2 sd; NaN for a
        single sample.

    Raises
    ------
    ValueError
        If shapes disagree, there is no sample or no reference, or a value is not finite.

    Warnings
    --------
    The MCC is not a correlation: sequences are not centred, so that two without anything in common
    still score high, and it grows with the number of frames. The MLC knows no lag: a sample out of
    step scores low. Neither sees levels and sizes. Copies of the training recordings (``replay``)
    score well without being new.

    Notes
    -----
    With S samples x, M references y and the D′ outputs that are kept:

    .. math:: \frac{1}{S M D'} \sum_{s, m, d} c(x_{sd}, y_{md})

    For the MCC, :math:`c(x, y) = \max_n \sum_t \tilde y_t \tilde x_{t + n}` over all lags n, with
    x̃ and ỹ scaled to [0, 1] by their own minimum and maximum. For the MLC, c is Pearson's
    correlation over the frames.

    References
    ----------
    J. D. Gil López (2017), Hierarchical Multiple Output Gaussian Processes for Human Motion Data,
    MSc thesis, Universidad Tecnológica de Pereira, §4.3.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Synthesis, mcc, mlc
    >>> times = np.linspace(0.0, 6.0, 50)[:, None]
    >>> references = np.stack([np.sin(times), np.cos(times)])
    >>> outcome = Synthesis(samples=np.stack([np.sin(times)]), references=references)
    >>> mlc(outcome).parts["reference"].round(3)
    array([1.   , 0.008])
    >>> round(mlc(outcome).value, 3), round(mcc(outcome).value, 3)
    (0.504, 16.013)
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
    r"""Return the mean correlation with the best-matched reference.

    The metrics ``mcc_best`` and ``mlc_best``. The best-matched reference is the one with the
    greatest mean correlation over samples and outputs: one reference for all samples. Higher is
    better; without unit. Outputs are left out as in `mcc`.

    Parameters
    ----------
    outcome : Synthesis
        With S samples and M references of D outputs over N frames.
    correlation : callable
        ``cross_correlation`` (MCC) or ``linear_correlation`` (MLC).

    Returns
    -------
    Score
        NaN for a single reference, where there is no choice. With part ``"sample"`` (S,), the
        correlation of each sample with the best-matched reference.

    Raises
    ------
    ValueError
        If shapes disagree, there is no sample or no reference, or a value is not finite.

    Warnings
    --------
    Samples that all repeat one recording score best: it rewards no variety. The more references
    there are, the higher is the best match: compare at equal numbers of references.

    Notes
    -----
    With S samples x, references y and the D′ outputs that are kept, and c as in ``mcc`` or ``mlc``:

    .. math:: \max_m \frac{1}{S D'} \sum_{s, d} c(x_{sd}, y_{md})

    References
    ----------
    Gil López (2017), §A.4.2; see `mcc`.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Synthesis, mcc_best, mlc_best
    >>> times = np.linspace(0.0, 6.0, 50)[:, None]
    >>> references = np.stack([np.sin(times), np.cos(times)])
    >>> outcome = Synthesis(samples=np.stack([np.sin(times)]), references=references)
    >>> round(mlc_best(outcome).value, 3), round(mcc_best(outcome).value, 3)
    (1.0, 18.993)
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
    r"""Return the marginal variance of the samples over that of the references.

    The metric ``variance_ratio``. The variance (ddof 1) is taken over sequences, at each frame of
    each output, around the sequences' mean there; it is averaged over frames and outputs before the
    division. The target is 1, without unit; samples that are all equal have 0.

    Parameters
    ----------
    outcome : Synthesis
        With S samples and M references of D outputs over N frames.

    Returns
    -------
    Score
        NaN for fewer than two samples or references. Without parts.

    Raises
    ------
    ValueError
        If shapes disagree, there is no sample or no reference, a value is not finite, or the
        references are equal.

    Warnings
    --------
    Too much variance in some frames or outputs can make up for too little in others, and noise
    counts as variance. Outputs with large values decide it. References that differ much, as those
    of several persons do, set a target that no model is told.

    Notes
    -----
    With the variances over sequences at frame t of output d:

    .. math::

        \frac{\sum_{t, d} \operatorname{var}_s x_{std}}{\sum_{t, d} \operatorname{var}_m y_{mtd}}

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Synthesis, variance_ratio
    >>> references = np.array([[[-1.0], [-1.0]], [[1.0], [1.0]]])
    >>> variance_ratio(Synthesis(samples=0.5 * references, references=references)).value
    0.25
    """
    check_synthesis(outcome)
    if min(len(outcome.samples), len(outcome.references)) < 2:
        return Score(np.nan)
    of_references = outcome.references.var(axis=0, ddof=1).mean()
    if of_references == 0:
        raise ValueError("variance_ratio: expected references that differ, got equal ones")
    return Score(float(outcome.samples.var(axis=0, ddof=1).mean() / of_references))


def _metric(
    name: str,
    title: str,
    similarity: Callable[..., Score],
    correlation: Correlation,
    sentence: str,
) -> Metric[Synthesis]:
    return Metric(
        name,
        title,
        Direction.HIGHER,
        Synthesis,
        partial(similarity, correlation=correlation),
        sentence=sentence,
        range=_RANGES[correlation],
        source="Gil López 2017",
    )


_RANGES: Mapping[Correlation, str] = {
    cross_correlation: "0 to the number of frames",
    linear_correlation: "−1 to 1",
}

mcc = _metric(
    "mcc",
    "Maximum cross-correlation (MCC)",
    mean_similarity,
    cross_correlation,
    "Likeness of samples and references at the best shift in time, channels scaled to [0, 1]; "
    "it grows with the number of frames.",
)
mlc = _metric(
    "mlc",
    "Mean linear correlation (MLC)",
    mean_similarity,
    linear_correlation,
    "Correlation of samples and references frame by frame, averaged over channels and references.",
)
mcc_best = _metric(
    "mcc_best",
    "Maximum cross-correlation, best match",
    best_similarity,
    cross_correlation,
    "MCC with the one reference that all samples together resemble most.",
)
mlc_best = _metric(
    "mlc_best",
    "Mean linear correlation, best match",
    best_similarity,
    linear_correlation,
    "MLC with the one reference that all samples together resemble most.",
)
variance_ratio = Metric(
    "variance_ratio",
    "Variance ratio",
    Direction.TARGET,
    Synthesis,
    marginal_variance_ratio,
    target=1.0,
    former_names=("spread",),
    sentence=(
        "How much samples vary around their mean, over how much references do: 0 for samples that "
        "are all equal."
    ),
    range="0 to ∞",
    source="this project",
)
