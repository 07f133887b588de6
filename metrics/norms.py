"""Mean norms of the error at hidden frames: of all outputs, of the angles, of the root's path."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.metrics.base import Direction, Score, metric
from mocapbench.metrics.outcomes.imputation import Imputation

__all__ = [
    "angle_error_per_frame",
    "rms_per_frame",
    "root_error_per_frame",
]

_ANGLE = "deg"


def _has_angles(outcome: Imputation) -> bool:
    return _ANGLE in outcome.units


def _has_angles_and_path(outcome: Imputation) -> bool:
    return _has_angles(outcome) and set(outcome.units) != {_ANGLE}


@metric(
    title="Mean error norm per frame (degrees and root steps, mixed)",
    direction=Direction.LOWER,
    sentence=(
        "Mean over hidden frames of the Euclidean norm of the error of all channels, degrees and "
        "root steps added as they are."
    ),
    unit="that of the data",
    range="0 to ∞",
    source="Wang et al. 2008",
)
def rms_per_frame(outcome: Imputation) -> Score:
    r"""Return the mean over hidden frames of ‖y_t − μ_t‖.

    The norm is Euclidean, over the hidden entries of frame t; a frame counts if any of its entries
    is hidden. It is not the root of a mean square: the name is that of the paper's table. It adds
    up the units of the outputs as they are: degrees, and steps of the root in the skeleton's unit
    of length.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames.

    Returns
    -------
    Score
        With part ``"frame"`` (N,), the norms; NaN at frames without hidden entries.

    Warnings
    --------
    It adds squared degrees and squared root steps, and grows with the number of hidden channels:
    values from other sets of channels cannot be compared.

    See Also
    --------
    angle_error_per_frame, root_error_per_frame : Its two parts, each in one unit.

    Notes
    -----
    With T the frames in which an entry is hidden, and :math:`H_t` the hidden outputs of frame t:

    .. math:: \frac{1}{|T|} \sum_{t \in T} \sqrt{\sum_{d \in H_t} (y_{td} - \mu_{td})^2}

    References
    ----------
    Wang, Fleet and Hertzmann (2008), Gaussian process dynamical models for human motion (GPDM),
    Table 2. Its "RMS error per frame" is this mean norm and not the root of a mean square.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, rms_per_frame
    >>> outcome = Imputation(
    ...     truth=np.array([[1.0, 5.0], [3.0, 9.0]]),
    ...     mean=np.array([[1.0, 5.0], [2.0, 5.0]]),
    ...     variance=None,
    ...     hidden=np.full((2, 2), True),
    ...     visible_mean=np.zeros(2),
    ...     visible_variance=np.ones(2),
    ... )
    >>> round(rms_per_frame(outcome).value, 6)
    2.061553
    >>> rms_per_frame(outcome).parts["frame"].round(6)
    array([0.      , 4.123106])
    """
    return _mean_norm(outcome, np.full(len(outcome.visible_mean), True))


@metric(
    title="Mean error norm per frame, angles (degrees)",
    direction=Direction.LOWER,
    sentence=("Mean over hidden frames of the Euclidean norm of the error of all hidden angles."),
    unit="degrees",
    range="0 to ∞",
    source="this project",
    defined=_has_angles,
)
def angle_error_per_frame(outcome: Imputation) -> Score:
    r"""Return the mean over frames of the norm of the error of the hidden angles.

    It is as `rms_per_frame`, over the outputs whose unit is ``deg`` and over the frames in which
    one of them is hidden.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames, some of them angles.

    Returns
    -------
    Score
        NaN if no angle is hidden. With part ``"frame"`` (N,), the norms.

    Warnings
    --------
    It grows with the number of hidden angles, and a degree counts the same at the hip, where it
    moves the whole leg, and at the wrist.

    Notes
    -----
    With T the frames in which an angle is hidden, and :math:`A_t` the hidden angles of frame t:

    .. math:: \frac{1}{|T|} \sum_{t \in T} \sqrt{\sum_{d \in A_t} (y_{td} - \mu_{td})^2}

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, angle_error_per_frame
    >>> outcome = Imputation(
    ...     truth=np.array([[3.0, 4.0, 1.0]]),
    ...     mean=np.zeros((1, 3)),
    ...     variance=None,
    ...     hidden=np.full((1, 3), True),
    ...     visible_mean=np.zeros(3),
    ...     visible_variance=np.ones(3),
    ...     units=("deg", "deg", ""),
    ... )
    >>> angle_error_per_frame(outcome).value
    5.0
    """
    return _mean_norm(outcome, np.array([unit == _ANGLE for unit in outcome.units]))


@metric(
    title="Mean error norm per frame, root translation (skeleton's unit of length)",
    direction=Direction.LOWER,
    sentence=(
        "Mean over hidden frames of the Euclidean norm of the error of the root’s translation or "
        "steps."
    ),
    unit="skeleton units (5.64 cm in the CMU database)",
    range="0 to ∞",
    source="this project",
    defined=_has_angles_and_path,
)
def root_error_per_frame(outcome: Imputation) -> Score:
    r"""Return the mean over frames of the error norm of the hidden outputs that are not angles.

    Of motions on a skeleton these are the root's translation, or its steps from frame to frame.
    Otherwise as `rms_per_frame`, over the frames in which one of them is hidden.

    Parameters
    ----------
    outcome : Imputation
        With D outputs over N frames, some of them angles.

    Returns
    -------
    Score
        NaN if none is hidden. With part ``"frame"`` (N,), the norms.

    Warnings
    --------
    Where the outputs are steps, it says nothing of where the steps lead: small errors that all
    point the same way add up to a wrong path, which ``mpjpe_global`` shows.

    Notes
    -----
    With T the frames in which such an output is hidden, and :math:`R_t` those hidden in frame t:

    .. math:: \frac{1}{|T|} \sum_{t \in T} \sqrt{\sum_{d \in R_t} (y_{td} - \mu_{td})^2}

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, root_error_per_frame
    >>> outcome = Imputation(
    ...     truth=np.array([[3.0, 4.0, 1.0]]),
    ...     mean=np.zeros((1, 3)),
    ...     variance=None,
    ...     hidden=np.full((1, 3), True),
    ...     visible_mean=np.zeros(3),
    ...     visible_variance=np.ones(3),
    ...     units=("deg", "deg", ""),
    ... )
    >>> root_error_per_frame(outcome).value
    1.0
    """
    return _mean_norm(outcome, np.array([unit != _ANGLE for unit in outcome.units]))


def _mean_norm(outcome: Imputation, counts: NDArray[np.bool_]) -> Score:
    """Return the mean norm over the hidden entries of the outputs that count (D,)."""
    hidden = outcome.hidden & counts
    errors = np.where(hidden, outcome.truth - outcome.mean, 0.0)
    norms = np.where(hidden.any(axis=1), np.linalg.norm(errors, axis=1), np.nan)
    mean = float(np.nanmean(norms)) if hidden.any() else float("nan")
    return Score(mean, {"frame": norms})
