"""Resemblance of sampled to reference recordings, and how much the samples vary."""

from __future__ import annotations

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.metrics.base import Direction, Score, metric
from mocapbench.metrics.correlation import (
    SampleByReferenceByOutput,
    cross_correlation,
    linear_correlation,
)
from mocapbench.metrics.outcomes.synthesis import Synthesis

__all__ = [
    "mcc",
    "mcc_best",
    "mlc",
    "mlc_best",
    "variance_ratio",
]


@metric(
    title="Maximum cross-correlation (MCC)",
    direction=Direction.HIGHER,
    sentence=(
        "Likeness of samples and references at the best shift in time, channels scaled to [0, 1]; "
        "it grows with the number of frames."
    ),
    range="0 to the number of frames",
    source="Gil López 2017",
)
def mcc(outcome: Synthesis) -> Score:
    r"""Return the mean over samples, references and outputs of the greatest cross-correlation.

    The thesis calls it mean cross correlation. An output that is constant in any sample or
    reference is left out.

    Parameters
    ----------
    outcome : Synthesis
        With S samples and M references of D outputs over N frames.

    Returns
    -------
    Score
        NaN if all outputs are left out. With parts ``"output"`` (D,), ``"sample"`` (S,) and
        ``"reference"`` (M,), the means over the other axes, and ``"reference_sd"`` (M,), the
        standard deviation (ddof 1) over samples, of which the thesis gives mean ± 2 sd; NaN for a
        single sample.

    Warnings
    --------
    It is not a correlation: sequences are not centred, so that two without anything in common still
    score high, and it grows with the number of frames. It does not see levels and sizes. Copies of
    the training recordings (``replay``) score well without being new.

    Notes
    -----
    With S samples x, M references y and the D′ outputs that are kept, x̃ and ỹ scaled to [0, 1] by
    their own minimum and maximum, and all lags n:

    .. math:: \frac{1}{S M D'} \sum_{s, m, d} \max_n \sum_t \tilde y_{md, t} \tilde x_{sd, t + n}

    References
    ----------
    J. D. Gil López (2017), Hierarchical Multiple Output Gaussian Processes for Human Motion Data,
    MSc thesis, Universidad Tecnológica de Pereira, §4.3.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Synthesis, mcc
    >>> times = np.linspace(0.0, 6.0, 50)[:, None]
    >>> references = np.stack([np.sin(times), np.cos(times)])
    >>> outcome = Synthesis(samples=np.stack([np.sin(times)]), references=references)
    >>> round(mcc(outcome).value, 3)
    16.013
    """
    return _mean(cross_correlation(outcome))


@metric(
    title="Mean linear correlation (MLC)",
    direction=Direction.HIGHER,
    sentence=(
        "Correlation of samples and references frame by frame, averaged over channels and "
        "references."
    ),
    range="−1 to 1",
    source="Gil López 2017",
)
def mlc(outcome: Synthesis) -> Score:
    r"""Return the mean over samples, references and outputs of Pearson's correlation over frames.

    Parameters
    ----------
    outcome : Synthesis
        With S samples and M references of D outputs over N frames.

    Returns
    -------
    Score
        NaN if all outputs are left out. With the parts of `mcc`.

    Warnings
    --------
    It knows no lag: a sample out of step scores low. It does not see levels and sizes. Copies of
    the training recordings (``replay``) score well without being new.

    Notes
    -----
    With S samples x, M references y, the D′ outputs that are kept as in `mcc`, and r Pearson's
    correlation over the frames:

    .. math:: \frac{1}{S M D'} \sum_{s, m, d} r(x_{sd}, y_{md})

    References
    ----------
    J. D. Gil López (2017), Hierarchical Multiple Output Gaussian Processes for Human Motion Data,
    MSc thesis, Universidad Tecnológica de Pereira, §4.3.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Synthesis, mlc
    >>> times = np.linspace(0.0, 6.0, 50)[:, None]
    >>> references = np.stack([np.sin(times), np.cos(times)])
    >>> outcome = Synthesis(samples=np.stack([np.sin(times)]), references=references)
    >>> mlc(outcome).parts["reference"].round(3)
    array([1.   , 0.008])
    >>> round(mlc(outcome).value, 3)
    0.504
    """
    return _mean(linear_correlation(outcome))


@metric(
    title="Maximum cross-correlation, best match",
    direction=Direction.HIGHER,
    sentence="MCC with the one reference that all samples together resemble most.",
    range="0 to the number of frames",
    source="Gil López 2017",
)
def mcc_best(outcome: Synthesis) -> Score:
    r"""Return the mean of the greatest cross-correlation with the best-matched reference.

    The best-matched reference is the one with the greatest mean over samples and outputs: one
    reference for all samples. Outputs are left out as in `mcc`.

    Parameters
    ----------
    outcome : Synthesis
        With S samples and M references of D outputs over N frames.

    Returns
    -------
    Score
        NaN for a single reference, where there is no choice. With part ``"sample"`` (S,), the
        mean of each sample with the best-matched reference.

    Warnings
    --------
    Samples that all repeat one recording score best: it rewards no variety. The more references
    there are, the higher is the best match: compare at equal numbers of references.

    Notes
    -----
    With S samples x, references y, the D′ outputs that are kept, and c the cross-correlation of
    `mcc`:

    .. math:: \max_m \frac{1}{S D'} \sum_{s, d} c(x_{sd}, y_{md})

    References
    ----------
    Gil López (2017), §A.4.2; see `mcc`.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Synthesis, mcc_best
    >>> times = np.linspace(0.0, 6.0, 50)[:, None]
    >>> references = np.stack([np.sin(times), np.cos(times)])
    >>> outcome = Synthesis(samples=np.stack([np.sin(times)]), references=references)
    >>> round(mcc_best(outcome).value, 3)
    18.993
    """
    return _best_match(cross_correlation(outcome))


@metric(
    title="Mean linear correlation, best match",
    direction=Direction.HIGHER,
    sentence="MLC with the one reference that all samples together resemble most.",
    range="−1 to 1",
    source="Gil López 2017",
)
def mlc_best(outcome: Synthesis) -> Score:
    r"""Return the mean of Pearson's correlation with the best-matched reference.

    The reference is chosen, and outputs are left out, as in `mcc_best`.

    Parameters
    ----------
    outcome : Synthesis
        With S samples and M references of D outputs over N frames.

    Returns
    -------
    Score
        As `mcc_best`.

    Warnings
    --------
    Samples that all repeat one recording score best: it rewards no variety. The more references
    there are, the higher is the best match: compare at equal numbers of references.

    Notes
    -----
    With S samples x, references y, the D′ outputs that are kept, and r Pearson's correlation over
    the frames:

    .. math:: \max_m \frac{1}{S D'} \sum_{s, d} r(x_{sd}, y_{md})

    References
    ----------
    Gil López (2017), §A.4.2; see `mcc`.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Synthesis, mlc_best
    >>> times = np.linspace(0.0, 6.0, 50)[:, None]
    >>> references = np.stack([np.sin(times), np.cos(times)])
    >>> outcome = Synthesis(samples=np.stack([np.sin(times)]), references=references)
    >>> round(mlc_best(outcome).value, 3)
    1.0
    """
    return _best_match(linear_correlation(outcome))


def _mean(values: SampleByReferenceByOutput) -> Score:
    """Return the mean over samples, references and the outputs that are not NaN."""
    pairs, left_out = _over_outputs(values)
    parts = {
        "output": values.mean(axis=(0, 1)),
        "sample": pairs.mean(axis=1),
        "reference": pairs.mean(axis=0),
        "reference_sd": _deviation(pairs),
    }
    return Score(float(pairs.mean()), parts, left_out)


def _best_match(values: SampleByReferenceByOutput) -> Score:
    """Return the mean with the reference that all samples together resemble most."""
    pairs, left_out = _over_outputs(values)
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


@metric(
    title="Variance ratio",
    direction=Direction.TARGET,
    target=1.0,
    sentence=(
        "How much samples vary around their mean, over how much references do: 0 for samples that "
        "are all equal."
    ),
    range="0 to ∞",
    source="this project",
)
def variance_ratio(outcome: Synthesis) -> Score:
    r"""Return the marginal variance of the samples over that of the references.

    The variance (ddof 1) is taken over sequences, at each frame of each output, around the
    sequences' mean there; it is averaged over frames and outputs before the division. Samples that
    are all equal have 0.

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
        If the references are equal.

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
    if min(len(outcome.samples), len(outcome.references)) < 2:
        return Score(np.nan)
    of_references = outcome.references.var(axis=0, ddof=1).mean()
    if of_references == 0:
        raise ValueError("variance_ratio: expected references that differ, got equal ones")
    return Score(float(outcome.samples.var(axis=0, ddof=1).mean() / of_references))
