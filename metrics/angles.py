"""Errors of joint angles in degrees, as two papers on subject 35 of the CMU database state them.

- G. W. Taylor, G. E. Hinton and S. T. Roweis, *Modeling Human Motion Using Binary Latent
  Variables*, NIPS 19, 2006.
- N. D. Lawrence, *Learning for Larger Datasets with the Gaussian Process Latent Variable Model*,
  AISTATS, 2007.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.metrics.base import Direction, Metric, Score
from mocapbench.metrics.entries import hidden_entries, mean_over
from mocapbench.metrics.outcomes.imputation import Imputation

__all__ = [
    "cumulative_error_of_scaled_angles",
    "cumulative_scaled_error",
    "rms_angle",
    "root_mean_square_of_angles",
]

Array = NDArray[np.float64]


def root_mean_square_of_angles(outcome: Imputation) -> Score:
    r"""Return √(mean of (y − μ)²) over the hidden entries of joint angles.

    The metric ``rms_angle``. Joint angles are the outputs that have a scale; the mean is over all
    their hidden entries together. Lower is better; in degrees.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames, and ``scales``.

    Returns
    -------
    Score
        NaN if no joint angle is hidden.

    Raises
    ------
    ValueError
        If shapes disagree, nothing is hidden, a hidden entry has no finite truth or mean, or there
        are no scales.

    Warnings
    --------
    A few large errors decide it. A degree counts the same at the hip, where it moves the whole leg,
    and at the wrist.

    Notes
    -----
    With H the hidden entries (t, d) of joint angles:

    .. math:: \mathrm{RMS} = \sqrt{\frac{1}{|H|} \sum_{(t, d) \in H} (y_{td} - \mu_{td})^2}

    References
    ----------
    Lawrence (2007), the errors in degrees.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, rms_angle
    >>> outcome = Imputation(
    ...     truth=np.array([[1.0, 5.0], [3.0, 9.0]]),
    ...     mean=np.array([[1.0, 5.0], [2.0, 5.0]]),
    ...     variance=None,
    ...     hidden=np.full((2, 2), True),
    ...     visible_mean=np.zeros(2),
    ...     visible_variance=np.ones(2),
    ...     scales=np.array([0.5, 0.25]),
    ... )
    >>> round(rms_angle(outcome).value, 6)
    2.061553
    """
    errors, entries, _ = _hidden_angles(outcome)
    return Score(float(np.sqrt(mean_over(errors.ravel() ** 2, entries.ravel(), axis=0))))


def cumulative_error_of_scaled_angles(outcome: Imputation) -> Score:
    r"""Return Σ over frames of (s_d (y − μ))², the mean over hidden joint angles d.

    The metric ``cumulative_scaled_error``. Joint angles are the outputs that have a scale s_d; an
    angle counts if any of its entries is hidden, and the sum is over these. Lower is better,
    without unit. It grows with the number of hidden frames.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames, and ``scales``.

    Returns
    -------
    Score
        NaN if no joint angle is hidden. With part ``"output"`` (D,), the sums.

    Raises
    ------
    ValueError
        If shapes disagree, nothing is hidden, a hidden entry has no finite truth or mean, or there
        are no scales.

    Warnings
    --------
    It is a sum over frames: values of gaps of different lengths cannot be compared.

    Notes
    -----
    With A the joint angles of which an entry is hidden, and :math:`H_d` the hidden frames of angle
    d:

    .. math:: \frac{1}{|A|} \sum_{d \in A} \sum_{t \in H_d} s_d^2 \, (y_{td} - \mu_{td})^2

    References
    ----------
    Taylor, Hinton and Roweis (2006); Lawrence (2007).

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, cumulative_scaled_error
    >>> outcome = Imputation(
    ...     truth=np.array([[1.0, 5.0], [3.0, 9.0]]),
    ...     mean=np.array([[1.0, 5.0], [2.0, 5.0]]),
    ...     variance=None,
    ...     hidden=np.full((2, 2), True),
    ...     visible_mean=np.zeros(2),
    ...     visible_variance=np.ones(2),
    ...     scales=np.array([0.5, 0.25]),
    ... )
    >>> cumulative_scaled_error(outcome).value
    0.625
    >>> cumulative_scaled_error(outcome).parts["output"]
    array([0.25, 1.  ])
    """
    errors, entries, scales = _hidden_angles(outcome)
    sums = np.where(entries, (errors * scales) ** 2, 0.0).sum(axis=0)
    counted = entries.any(axis=0)
    value = float(sums[counted].mean()) if counted.any() else float("nan")
    return Score(value, {"output": np.where(counted, sums, np.nan)})


def _hidden_angles(outcome: Imputation) -> tuple[Array, NDArray[np.bool_], Array]:
    """Return the errors (N, D), where joint angles are hidden (N, D), and the scales (D,)."""
    hidden = hidden_entries(outcome)
    if outcome.scales is None:
        raise ValueError("expected scales of the joint angles, got None: this metric needs them")
    errors = np.where(hidden, outcome.truth - outcome.mean, 0.0)
    return errors, hidden & ~np.isnan(outcome.scales), outcome.scales


def _has_scales(outcome: Imputation) -> bool:
    return outcome.scales is not None


rms_angle = Metric(
    "rms_angle",
    "RMS error of joint angles, degrees",
    Direction.LOWER,
    Imputation,
    root_mean_square_of_angles,
    defined=_has_scales,
    sentence="Root mean square error over all hidden joint angles.",
    unit="degrees",
    range="0 to ∞",
    source="Lawrence 2007",
)
cumulative_scaled_error = Metric(
    "cumulative_scaled_error",
    "Cumulative scaled error",
    Direction.LOWER,
    Imputation,
    cumulative_error_of_scaled_angles,
    defined=_has_scales,
    sentence=(
        "Squared errors of joint angles, each multiplied by its scale, summed over hidden frames "
        "and averaged over angles; it grows with the gap."
    ),
    range="0 to ∞",
    source="Taylor et al. 2006",
)
