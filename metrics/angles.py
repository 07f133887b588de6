"""Errors of joint angles in degrees, as two papers on subject 35 of the CMU database state them.

- G. W. Taylor, G. E. Hinton and S. T. Roweis, *Modeling Human Motion Using Binary Latent
  Variables*, NIPS 19, 2006.
- N. D. Lawrence, *Learning for Larger Datasets with the Gaussian Process Latent Variable Model*,
  AISTATS, 2007.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.metrics.base import Direction, Score, metric
from mocapbench.metrics.entries import mean_over
from mocapbench.metrics.outcomes.imputation import Imputation

__all__ = [
    "cumulative_scaled_error",
    "rms_angle",
]


def _has_scales(outcome: Imputation) -> bool:
    return outcome.scales is not None


@metric(
    title="RMS error of joint angles, degrees",
    direction=Direction.LOWER,
    sentence="Root mean square error over all hidden joint angles.",
    unit="degrees",
    range="0 to ∞",
    source="Lawrence 2007",
    defined=_has_scales,
)
def rms_angle(outcome: Imputation) -> Score:
    r"""Return √(mean of (y − μ)²) over the hidden entries of joint angles.

    Joint angles are the outputs that have a scale; the mean is over all their hidden entries
    together.

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
        If there are no scales.

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


@metric(
    title="Cumulative scaled error",
    direction=Direction.LOWER,
    sentence=(
        "Squared errors of joint angles, each multiplied by its scale, summed over hidden frames "
        "and averaged over angles; it grows with the gap."
    ),
    range="0 to ∞",
    source="Taylor et al. 2006",
    defined=_has_scales,
)
def cumulative_scaled_error(outcome: Imputation) -> Score:
    r"""Return Σ over frames of (s_d (y − μ))², the mean over hidden joint angles d.

    Joint angles are the outputs that have a scale s_d; an angle counts if any of its entries is
    hidden, and the sum is over these. It grows with the number of hidden frames.

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
        If there are no scales.

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
    hidden = outcome.hidden
    if outcome.scales is None:
        raise ValueError("expected scales of the joint angles, got None: this metric needs them")
    errors = np.where(hidden, outcome.truth - outcome.mean, 0.0)
    return errors, hidden & ~np.isnan(outcome.scales), outcome.scales
