"""The likelihood of the hidden entries under the prediction."""

from __future__ import annotations

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.metrics.base import Direction, Score, metric
from mocapbench.metrics.entries import DEGENERATE, average, deviations
from mocapbench.metrics.outcomes.imputation import Imputation

__all__ = ["msll"]


def _log_loss(values: Array, mean: Array, variance: Array) -> Array:
    """Return −log N(values; mean, variance)."""
    return np.asarray(0.5 * np.log(2 * np.pi * variance) + (values - mean) ** 2 / (2 * variance))


@metric(
    title="Mean standardised log loss (MSLL)",
    direction=Direction.LOWER,
    sentence=(
        "Log loss of the predictive distributions minus that of each channel’s visible mean and "
        "variance, which therefore scores 0."
    ),
    unit="nats",
    range="−∞ to ∞",
    source="Rasmussen and Williams 2006",
    needs_variance=True,
)
def msll(outcome: Imputation) -> Score:
    r"""Return the mean log loss of the hidden entries less that of a trivial model.

    The loss of an entry is ½ log(2πσ²) + (y − μ)² / (2σ²), with σ² the predictive variance of an
    observation, noise included. The trivial model is a Gaussian with the mean and the variance
    (ddof 0) of the output's visible entries; it scores 0. Outputs whose visible variance is below
    1e-12 are left out.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames, and a predictive variance.

    Returns
    -------
    Score
        NaN if all outputs are left out. With parts ``"output"`` (D,) and ``"frame"`` (N,), the
        means over the hidden entries of each.

    Raises
    ------
    ValueError
        If there is no predictive variance.

    Warnings
    --------
    It has no upper bound: a few entries with far too small a variance can decide the mean of all
    others.

    Notes
    -----
    With H the hidden entries (t, d), and :math:`m_d` and :math:`v_d` the mean and variance of the
    visible entries of output d:

    .. math::

        \mathrm{MSLL} = \frac{1}{|H|} \sum_{(t, d) \in H} \Bigl[
        - \log N(y_{td}; \mu_{td}, \sigma_{td}^2) + \log N(y_{td}; m_d, v_d) \Bigr]

    References
    ----------
    Rasmussen and Williams (2006), Gaussian Processes for Machine Learning, §2.5.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, msll
    >>> outcome = Imputation(
    ...     truth=np.array([[0.0, 1.0], [1.0, 0.0]]),
    ...     mean=np.zeros((2, 2)),
    ...     variance=np.full((2, 2), 0.5),
    ...     hidden=np.full((2, 2), True),
    ...     visible_mean=np.zeros(2),
    ...     visible_variance=np.ones(2),
    ... )
    >>> round(msll(outcome).value, 6)
    -0.096574
    """
    variance = deviations(outcome) ** 2
    kept = outcome.visible_variance >= DEGENERATE
    trivial_variance = np.where(kept, outcome.visible_variance, 1.0)
    loss = _log_loss(outcome.truth, outcome.mean, variance)
    trivial = _log_loss(outcome.truth, outcome.visible_mean, trivial_variance)
    hidden = outcome.hidden
    left_out = int((hidden.any(axis=0) & ~kept).sum())
    return average(loss - trivial, hidden & kept, left_out)
