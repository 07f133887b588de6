"""Errors of rotations and of normalised positions, as papers on in-betweening print them.

F. G. Harvey, M. Yurick, D. Nowrouzezahrai and C. Pal 2020, *Robust Motion In-betweening*, by the
code of its data set.
"""

from __future__ import annotations

import numpy as np

from mocapbench.metrics.base import Direction, Score, has_poses, metric
from mocapbench.metrics.norms import rms_per_frame
from mocapbench.metrics.outcomes.imputation import Imputation

__all__ = ["QUATERNION", "l2p", "l2q"]

QUATERNION = "quaternion"
"""Unit of an output that is one of the four numbers of a rotation in space."""


def _are_rotations(outcome: Imputation) -> bool:
    return set(outcome.units) == {QUATERNION}


def _have_spread(outcome: Imputation) -> bool:
    return has_poses(outcome) and outcome.poses.spread is not None


@metric(
    title="Error of all rotations (L2Q)",
    direction=Direction.LOWER,
    sentence=(
        "Distance of the quaternions of all joints in space from the true ones, all in one, mean "
        "over hidden frames."
    ),
    range="0 to ∞",
    source="Harvey et al. 2020",
    defined=_are_rotations,
)
def l2q(outcome: Imputation) -> Score:
    r"""Return the mean over frames of the distance between the quaternions of all joints.

    It is one distance a frame, of 4 J numbers, so that it grows with the number of joints: that of
    `rms_per_frame`, where outputs are quaternions.

    Parameters
    ----------
    outcome : Imputation
        Whose outputs are the quaternions of J joints in space, hidden frame by frame.

    Returns
    -------
    Score
        With part ``"frame"`` (N,).

    Raises
    ------
    ValueError
        If outputs are others.

    Warnings
    --------
    q and −q are the same rotation and are far apart here: signs must be those of the truth. The
    error of a joint counts in all that it carries.

    See Also
    --------
    l2p : The same of positions.

    Notes
    -----
    With H the hidden frames and :math:`q_{tj}` the rotation of joint j in space:

    .. math:: \frac{1}{|H|} \sum_{t \in H} \sqrt{\sum_{j} \| \hat q_{tj} - q_{tj} \|^2}

    References
    ----------
    Harvey, Yurick, Nowrouzezahrai and Pal (2020), Robust motion in-betweening; the code of LaFAN1.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, l2q
    >>> outcome = Imputation(
    ...     truth=np.array([[1.0, 0.0, 0.0, 0.0]]),
    ...     mean=np.array([[0.6, 0.8, 0.0, 0.0]]),
    ...     variance=None,
    ...     hidden=np.full((1, 4), True),
    ...     visible_mean=np.zeros(4),
    ...     visible_variance=np.ones(4),
    ...     units=("quaternion",) * 4,
    ... )
    >>> round(l2q(outcome).value, 6)
    0.894427
    """
    if not _are_rotations(outcome):
        raise ValueError(
            f"expected outputs that are quaternions, got the units {sorted(set(outcome.units))}; "
            "score these by mse"
        )
    return rms_per_frame(outcome)


@metric(
    title="Error of all normalised positions (L2P)",
    direction=Direction.LOWER,
    sentence=(
        "Distance of all joints from the true ones, each coordinate over its standard deviation "
        "in training, all in one, mean over hidden frames."
    ),
    range="0 to ∞",
    source="Harvey et al. 2020",
    defined=_have_spread,
)
def l2p(outcome: Imputation) -> Score:
    r"""Return the mean over frames of the distance between all joints, normalised.

    It is one distance a frame, of 3 J coordinates in space, each divided by its standard deviation
    in the recordings that are learnt from.

    Parameters
    ----------
    outcome : Imputation
        With poses of J joints over N frames, and their ``spread``.

    Returns
    -------
    Score

    Raises
    ------
    ValueError
        If the poses have no spread.

    Warnings
    --------
    A centimetre counts the more, the less a coordinate varied: heights count more than the path.

    See Also
    --------
    mpjpe_global : The mean distance of a joint, in cm.

    Notes
    -----
    With H the frames in which something is hidden, and :math:`s_{ji}` the standard deviation of
    coordinate i of joint j:

    .. math::

        \frac{1}{|H|} \sum_{t \in H}
        \sqrt{\sum_{j, i} \left( \frac{\hat p_{tji} - p_{tji}}{s_{ji}} \right)^2}

    References
    ----------
    Harvey, Yurick, Nowrouzezahrai and Pal (2020), Robust motion in-betweening; the code of LaFAN1.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, ImputedPoses, l2p
    >>> truth, mean = np.zeros((2, 1, 2, 3))
    >>> mean[0, 1] = [3.0, 4.0, 0.0]
    >>> hidden = np.tile([False, True], (1, 1))
    >>> joints, times, spread = ("root", "knee"), np.arange(1) / 30, np.full((2, 3), 2.0)
    >>> poses = ImputedPoses(truth, mean, hidden, hidden, joints, (-1, 0), times, spread=spread)
    >>> outcome = Imputation(
    ...     truth=truth[:, 1],
    ...     mean=mean[:, 1],
    ...     variance=None,
    ...     hidden=np.full((1, 3), True),
    ...     visible_mean=np.zeros(3),
    ...     visible_variance=np.ones(3),
    ...     place_joints=lambda: poses,
    ... )
    >>> l2p(outcome).value
    2.5
    """
    poses = outcome.poses
    if poses.spread is None:
        raise ValueError(
            "expected the standard deviations of joints in training, got none; score them by "
            "mpjpe_global"
        )
    frames = poses.hidden.any(axis=1)
    apart = ((poses.mean - poses.truth) / poses.spread)[frames]
    return Score(float(np.linalg.norm(apart, axis=(1, 2)).mean()))
