"""Errors of the predicted mean at the hidden entries."""

from __future__ import annotations

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.metrics.base import Direction, Score, metric
from mocapbench.metrics.entries import (
    DEGENERATE,
    average,
    mean_over,
    variance_over,
)
from mocapbench.metrics.outcomes.imputation import Imputation

__all__ = [
    "mae",
    "mse",
    "smse",
    "smse_pooled",
]


def _squared_error(outcome: Imputation) -> Array:
    return np.asarray((outcome.truth - outcome.mean) ** 2)


@metric(
    title="Mean absolute error (MAE)",
    direction=Direction.LOWER,
    sentence="Mean absolute difference of prediction and truth at hidden entries.",
    unit="that of the data",
    range="0 to ∞",
    source="Kieu et al. 2022",
)
def mae(outcome: Imputation) -> Score:
    r"""Return the mean of ``|y − μ|`` over the hidden entries.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames.

    Returns
    -------
    Score
        With parts ``"output"`` (D,) and ``"frame"`` (N,), the means over the hidden entries of
        each.

    Warnings
    --------
    Where outputs are coordinates of markers, it is about half the distance from the true place:
    compare it with no error that is a distance.

    Notes
    -----
    With H the set of hidden entries (t, d):

    .. math:: \mathrm{MAE} = \frac{1}{|H|} \sum_{(t, d) \in H} | y_{td} - \mu_{td} |

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, mae
    >>> outcome = Imputation(
    ...     truth=np.array([[1.0, 5.0], [3.0, 9.0]]),
    ...     mean=np.array([[1.0, 5.0], [2.0, 5.0]]),
    ...     variance=None,
    ...     hidden=np.full((2, 2), True),
    ...     visible_mean=np.zeros(2),
    ...     visible_variance=np.ones(2),
    ... )
    >>> mae(outcome).value
    1.25
    >>> mae(outcome).parts["output"]
    array([0.5, 2. ])
    """
    return average(np.abs(outcome.truth - outcome.mean), outcome.hidden)


@metric(
    title="Mean squared error (MSE)",
    direction=Direction.LOWER,
    sentence="Mean squared difference of prediction and truth at hidden entries.",
    unit="that of the data, squared",
    range="0 to ∞",
    source="Rasmussen and Williams 2006",
)
def mse(outcome: Imputation) -> Score:
    r"""Return the mean of (y − μ)² over the hidden entries.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames.

    Returns
    -------
    Score
        With parts ``"output"`` (D,) and ``"frame"`` (N,), the means over the hidden entries of
        each.

    Warnings
    --------
    Outputs with large values decide it, and its size depends on the outputs: compare it only
    between models of one task.

    Notes
    -----
    With H the set of hidden entries (t, d):

    .. math:: \mathrm{MSE} = \frac{1}{|H|} \sum_{(t, d) \in H} (y_{td} - \mu_{td})^2

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, mse
    >>> outcome = Imputation(
    ...     truth=np.array([[1.0, 5.0], [3.0, 9.0]]),
    ...     mean=np.array([[1.0, 5.0], [2.0, 5.0]]),
    ...     variance=None,
    ...     hidden=np.full((2, 2), True),
    ...     visible_mean=np.zeros(2),
    ...     visible_variance=np.ones(2),
    ... )
    >>> mse(outcome).value
    4.25
    >>> mse(outcome).parts["output"]
    array([0.5, 8. ])
    """
    return average(_squared_error(outcome), outcome.hidden)


@metric(
    title="Standardised MSE (SMSE)",
    direction=Direction.LOWER,
    sentence=(
        "MSE over the variance of the true values, channel by channel, then averaged; predicting "
        "the mean scores 1."
    ),
    range="0 to ∞",
    source="Rasmussen and Williams 2006",
)
def smse(outcome: Imputation) -> Score:
    r"""Return the mean over outputs of MSE_d / var_d.

    MSE_d is the mean of (y − μ)² over the hidden entries of output d, and var_d the variance (ddof
    0) of its true values there. Predicting the mean of the hidden values scores 1. Outputs whose
    visible or hidden variance is below 1e-12 are left out.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames.

    Returns
    -------
    Score
        NaN if all outputs are left out. With part ``"output"`` (D,), MSE_d / var_d.

    Warnings
    --------
    Every output counts alike: one that hardly varies while it is hidden, and is missed by little,
    can outweigh all others. As a rule that variance is small in short gaps.

    See Also
    --------
    smse_pooled : One variance for all outputs.

    Notes
    -----
    With :math:`H_d` the hidden frames of output d, and :math:`\bar y_d` the mean of its true values
    there, over the D′ outputs that are kept:

    .. math::

        \mathrm{SMSE} = \frac{1}{D'} \sum_d
        \frac{\sum_{t \in H_d} (y_{td} - \mu_{td})^2}{\sum_{t \in H_d} (y_{td} - \bar y_d)^2}

    References
    ----------
    Rasmussen and Williams (2006), Gaussian Processes for Machine Learning, §2.5.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, smse
    >>> outcome = Imputation(
    ...     truth=np.array([[1.0, 5.0], [3.0, 9.0]]),
    ...     mean=np.array([[1.0, 5.0], [2.0, 5.0]]),
    ...     variance=None,
    ...     hidden=np.full((2, 2), True),
    ...     visible_mean=np.zeros(2),
    ...     visible_variance=np.ones(2),
    ... )
    >>> smse(outcome).value
    1.25
    >>> smse(outcome).parts["output"]
    array([0.5, 2. ])
    """
    hidden = outcome.hidden
    variance = variance_over(outcome.truth, hidden)
    kept = (outcome.visible_variance >= DEGENERATE) & (variance >= DEGENERATE)
    errors = mean_over(_squared_error(outcome), hidden & kept, axis=0)
    ratios = errors / np.where(kept, variance, 1.0)
    value = float(ratios[kept].mean()) if kept.any() else float("nan")
    return Score(value, {"output": ratios}, int((hidden.any(axis=0) & ~kept).sum()))


@metric(
    title="Standardised MSE of all channels together (pooled SMSE)",
    direction=Direction.LOWER,
    sentence=(
        "MSE over the variance of the true values, both over all channels together, as the thesis "
        "tabulates it."
    ),
    range="0 to ∞",
    source="Gil López 2017",
)
def smse_pooled(outcome: Imputation) -> Score:
    r"""Return MSE / var, both over the hidden entries of all outputs together.

    There is one variance (ddof 0), around one mean. The thesis (J. D. Gil López, *Hierarchical
    Multiple Output Gaussian Processes for Human Motion Data*, MSc thesis, Universidad Tecnológica
    de Pereira, 2017) tabulates this ratio as SMSE, as its columns of MSE show. Outputs whose
    visible variance is below 1e-12 are left out.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames.

    Returns
    -------
    Score
        NaN if no variance remains. With parts ``"output"`` (D,) and ``"frame"`` (N,), their MSE
        over the same pooled variance.

    Warnings
    --------
    Where outputs lie at different levels, these differences are part of the variance, and the ratio
    is small even for a model that predicts no more than each output's mean. It is not comparable
    with ``smse``.

    See Also
    --------
    smse : One variance per output.

    Notes
    -----
    With H the hidden entries (t, d) of the outputs that are kept, and :math:`\bar y` the mean of
    all their true values:

    .. math::

        \mathrm{SMSE} = \frac{\sum_{(t, d) \in H} (y_{td} - \mu_{td})^2}
        {\sum_{(t, d) \in H} (y_{td} - \bar y)^2}

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, smse_pooled
    >>> outcome = Imputation(
    ...     truth=np.array([[1.0, 5.0], [3.0, 9.0]]),
    ...     mean=np.array([[1.0, 5.0], [2.0, 5.0]]),
    ...     variance=None,
    ...     hidden=np.full((2, 2), True),
    ...     visible_mean=np.zeros(2),
    ...     visible_variance=np.ones(2),
    ... )
    >>> round(smse_pooled(outcome).value, 6)
    0.485714
    """
    hidden = outcome.hidden
    kept = outcome.visible_variance >= DEGENERATE
    scored = hidden & kept
    variance = outcome.truth[scored].var() if scored.any() else 0.0
    scale = variance if variance >= DEGENERATE else np.nan
    left_out = int((hidden.any(axis=0) & ~kept).sum())
    return average(_squared_error(outcome) / scale, scored, left_out)
