"""Quality of the predictive variance: coverage, PIT, sharpness and CRPS.

All take the predictive distribution of an observation as Gaussian, N(μ, σ²).
"""

from __future__ import annotations

from functools import partial

import numpy as np
from scipy.special import ndtr, ndtri

from mocapbench.basics.arrays import Array
from mocapbench.metrics.base import Direction, Metric, Score, metric
from mocapbench.metrics.entries import average, deviations
from mocapbench.metrics.outcomes.imputation import Imputation

__all__ = [
    "coverage_50",
    "coverage_80",
    "coverage_90",
    "coverage_95",
    "crps",
    "interval_coverage",
    "pit",
    "sharpness",
]


_PIT_BINS = 10


def _z_scores(outcome: Imputation) -> Array:
    return np.asarray((outcome.truth - outcome.mean) / deviations(outcome))


def interval_coverage(outcome: Imputation, level: float) -> Score:
    r"""Return the share of hidden entries inside their central intervals of probability ``level``.

    The metrics ``coverage_50``, ``coverage_80``, ``coverage_90`` and ``coverage_95``. An entry is
    inside where y is at most z σ from μ, with z the (1 + level) / 2 quantile of the standard normal
    distribution.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames, and a predictive variance.
    level : float
        Probability between 0 and 1.

    Returns
    -------
    Score
        With parts ``"output"`` (D,) and ``"frame"`` (N,), the shares in each.

    Raises
    ------
    ValueError
        If there is no predictive variance.

    Warnings
    --------
    Intervals that are too wide here and too narrow there can cover the right share, and very wide
    ones cover everything: read it beside ``sharpness``. Entries of one gap miss together, so that a
    few gaps say little.

    Notes
    -----
    With H the hidden entries (t, d):

    .. math::

        \frac{1}{|H|} \sum_{(t, d) \in H} \mathbf{1}\bigl[ |y_{td} - \mu_{td}| \le z \, \sigma_{td}
        \bigr], \qquad z = \Phi^{-1}\Bigl(\frac{1 + \mathrm{level}}{2}\Bigr)

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, coverage_50, coverage_95
    >>> outcome = Imputation(
    ...     truth=np.array([[0.0, 1.0], [2.0, -3.0]]),
    ...     mean=np.zeros((2, 2)),
    ...     variance=np.ones((2, 2)),
    ...     hidden=np.full((2, 2), True),
    ...     visible_mean=np.zeros(2),
    ...     visible_variance=np.ones(2),
    ... )
    >>> coverage_50(outcome).value, coverage_95(outcome).value
    (0.25, 0.5)
    """
    inside = np.abs(_z_scores(outcome)) <= ndtri((1 + level) / 2)
    return average(inside.astype(np.float64), outcome.hidden)


@metric(
    title="Probability integral transform (PIT), distance from uniform",
    direction=Direction.LOWER,
    sentence=(
        "How far the truth’s ranks within its predictive distributions are from uniform: 0 where "
        "the distributions are right."
    ),
    range="0 to 0.9",
    source="Gneiting et al. 2007",
    needs_variance=True,
)
def pit(outcome: Imputation) -> Score:
    r"""Return the distance of the PIT histogram from uniform, ``½ Σ_b |f_b − 1/10|``.

    f_b is the share of hidden entries whose probability integral transform (PIT) Φ((y − μ)/σ) falls
    in the b-th of ten equal bins of [0, 1]. The distance is the total variation: near 0 for
    calibrated predictions of many entries, and at most 0.9.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames, and a predictive variance.

    Returns
    -------
    Score
        With part ``"bin"`` (10,), the f_b.

    Raises
    ------
    ValueError
        If there is no predictive variance.

    Warnings
    --------
    It does not tell too wide from too narrow, nor either from a bias. Chance alone keeps it above 0
    where entries are few.

    Notes
    -----
    With H the hidden entries (t, d), and :math:`f_b` the share of them with :math:`\Phi((y_{td} -
    \mu_{td}) / \sigma_{td})` in bin b:

    .. math:: \frac12 \sum_{b = 1}^{10} \Bigl| f_b - \frac{1}{10} \Bigr|

    References
    ----------
    Gneiting, Balabdaoui and Raftery (2007), Probabilistic forecasts, calibration and sharpness,
    §3.1.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, pit
    >>> outcome = Imputation(
    ...     truth=np.array([[0.0, 1.0], [2.0, -3.0]]),
    ...     mean=np.zeros((2, 2)),
    ...     variance=np.ones((2, 2)),
    ...     hidden=np.full((2, 2), True),
    ...     visible_mean=np.zeros(2),
    ...     visible_variance=np.ones(2),
    ... )
    >>> round(pit(outcome).value, 6)
    0.6
    >>> pit(outcome).parts["bin"]
    array([0.25, 0.  , 0.  , 0.  , 0.  , 0.25, 0.  , 0.  , 0.25, 0.25])
    """
    transform = ndtr(_z_scores(outcome)[outcome.hidden])
    counts, _ = np.histogram(transform, bins=_PIT_BINS, range=(0.0, 1.0))
    shares = counts / transform.size
    return Score(float(0.5 * np.abs(shares - 1 / _PIT_BINS).sum()), {"bin": shares})


@metric(
    title="Sharpness (mean predictive sd)",
    direction=Direction.LOWER,
    sentence=(
        "Mean predictive standard deviation; small is good only among models whose intervals "
        "cover as they should."
    ),
    unit="that of the data",
    range="0 to ∞",
    source="Gneiting et al. 2007",
    needs_variance=True,
)
def sharpness(outcome: Imputation) -> Score:
    r"""Return the mean predictive standard deviation of the hidden entries.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames, and a predictive variance.

    Returns
    -------
    Score
        With parts ``"output"`` (D,) and ``"frame"`` (N,), the means over the hidden entries of
        each.

    Raises
    ------
    ValueError
        If there is no predictive variance.

    Warnings
    --------
    By itself it rewards a model for being too sure: read it beside coverage. It never looks at the
    truth.

    Notes
    -----
    With H the hidden entries (t, d):

    .. math:: \frac{1}{|H|} \sum_{(t, d) \in H} \sigma_{td}

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, sharpness
    >>> outcome = Imputation(
    ...     truth=np.array([[0.0, 1.0], [2.0, -3.0]]),
    ...     mean=np.zeros((2, 2)),
    ...     variance=np.ones((2, 2)),
    ...     hidden=np.full((2, 2), True),
    ...     visible_mean=np.zeros(2),
    ...     visible_variance=np.ones(2),
    ... )
    >>> sharpness(outcome).value
    1.0
    """
    return average(deviations(outcome), outcome.hidden)


@metric(
    title="Continuous ranked probability score (CRPS)",
    direction=Direction.LOWER,
    sentence=(
        "Absolute error of a predictive distribution: small where it is both near the truth and "
        "narrow."
    ),
    unit="that of the data",
    range="0 to ∞",
    source="Gneiting and Raftery 2007",
    needs_variance=True,
)
def crps(outcome: Imputation) -> Score:
    r"""Return the mean continuous ranked probability score of the hidden entries.

    For a Gaussian it is σ [z (2Φ(z) − 1) + 2φ(z) − 1/√π] with z = (y − μ)/σ.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames, and a predictive variance.

    Returns
    -------
    Score
        With parts ``"output"`` (D,) and ``"frame"`` (N,), the means over the hidden entries of
        each.

    Raises
    ------
    ValueError
        If there is no predictive variance.

    Warnings
    --------
    It is in the unit of the outputs, so that outputs with large values decide it. It forgives too
    small a variance more than ``msll`` does.

    Notes
    -----
    With H the hidden entries (t, d), φ and Φ the density and the distribution function of the
    standard normal distribution, and :math:`z = (y - \mu) / \sigma` of each entry:

    .. math::

        \mathrm{CRPS} = \frac{1}{|H|} \sum_{(t, d) \in H} \sigma_{td} \Bigl[
        z_{td} \bigl(2 \Phi(z_{td}) - 1\bigr) + 2 \varphi(z_{td}) - \frac{1}{\sqrt{\pi}} \Bigr]

    References
    ----------
    Gneiting and Raftery (2007), Strictly proper scoring rules, prediction, and estimation, eq.
    (21), with the sign that makes lower better.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, crps
    >>> outcome = Imputation(
    ...     truth=np.array([[0.0, 1.0], [2.0, -3.0]]),
    ...     mean=np.zeros((2, 2)),
    ...     variance=np.ones((2, 2)),
    ...     hidden=np.full((2, 2), True),
    ...     visible_mean=np.zeros(2),
    ...     visible_variance=np.ones(2),
    ... )
    >>> round(crps(outcome).value, 6)
    1.181376
    """
    z = _z_scores(outcome)
    density = np.exp(-0.5 * z**2) / np.sqrt(2 * np.pi)
    scores = deviations(outcome) * (z * (2 * ndtr(z) - 1) + 2 * density - 1 / np.sqrt(np.pi))
    return average(scores, outcome.hidden)


def _declare_coverage(percent: int) -> Metric[Imputation]:
    level = percent / 100
    declare = metric(
        name=f"coverage_{percent}",
        title=f"Coverage of the {percent} % interval",
        direction=Direction.TARGET,
        target=level,
        sentence=(
            f"Share of hidden entries inside their central {percent} % interval: less is too sure, "
            "more too cautious."
        ),
        range="0 to 1",
        source="Gneiting et al. 2007",
        needs_variance=True,
    )
    return declare(partial(interval_coverage, level=level))


coverage_50: Metric[Imputation] = _declare_coverage(50)
coverage_80: Metric[Imputation] = _declare_coverage(80)
coverage_90: Metric[Imputation] = _declare_coverage(90)
coverage_95: Metric[Imputation] = _declare_coverage(95)
