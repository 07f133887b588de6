"""Errors of joint positions and of bone lengths, in centimetres."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array, Mask
from mocapbench.metrics.base import Direction, Score, has_poses, metric
from mocapbench.metrics.entries import mean_over
from mocapbench.metrics.outcomes.imputation import Imputation

__all__ = [
    "bone_length_error",
    "mpjpe",
    "mpjpe_global",
]


def _are_positions(outcome: Imputation) -> bool:
    """Return whether the outputs themselves are positions, which need not keep bones rigid."""
    return has_poses(outcome) and set(outcome.units) == {"cm"}


@metric(
    title="Joint position error relative to the root (MPJPE), cm",
    direction=Direction.LOWER,
    sentence=(
        "Mean distance of predicted joints from true ones, both placed by forward kinematics "
        "relative to the root."
    ),
    unit="cm",
    range="0 to ∞",
    source="Ionescu et al. 2014",
    defined=has_poses,
)
def mpjpe(outcome: Imputation) -> Score:
    r"""Return the mean distance of predicted from true joints, both relative to the root.

    With p_tj the position of joint j at frame t, it is the mean of ‖(p̂_tj − p̂_t,root) − (p_tj −
    p_t,root)‖ over the joints and frames whose position relative to the root depends on a hidden
    entry. Orientations are not aligned.

    Parameters
    ----------
    outcome : Imputation
        With poses of J joints over N frames.

    Returns
    -------
    Score
        NaN if no such joint is hidden. With parts ``"joint"`` (J,) and ``"frame"`` (N,), the means
        over the hidden joints of each.

    Raises
    ------
    ValueError
        If the outcome has no poses.

    Warnings
    --------
    A fill that averages many motions can have a small error and still look stiff or slide: read it
    beside ``jerk_ratio`` and ``foot_skate``. Where the root's rotation is hidden, its error moves
    every joint.

    See Also
    --------
    mpjpe_global : The same in space, with the error of the root.

    Notes
    -----
    With H the joints and frames that count, and r the root:

    .. math::

        \mathrm{MPJPE} = \frac{1}{|H|} \sum_{(t, j) \in H}
        \bigl\| (\hat p_{tj} - \hat p_{tr}) - (p_{tj} - p_{tr}) \bigr\|

    References
    ----------
    Ionescu, Papava, Olaru and Sminchisescu (2014), Human3.6M (MPJPE, with the root aligned).

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, ImputedPoses, mpjpe
    >>> truth, mean = np.zeros((2, 1, 2, 3))
    >>> mean[0, 1] = [3.0, 4.0, 0.0]
    >>> hidden = np.tile([False, True], (1, 1))
    >>> times = np.arange(1) / 30
    >>> poses = ImputedPoses(truth, mean, hidden, hidden, ("root", "knee"), (-1, 0), times)
    >>> outcome = Imputation(
    ...     truth=truth[:, 1],
    ...     mean=mean[:, 1],
    ...     variance=None,
    ...     hidden=np.full((1, 3), True),
    ...     visible_mean=np.zeros(3),
    ...     visible_variance=np.ones(3),
    ...     place_joints=lambda: poses,
    ... )
    >>> mpjpe(outcome).value
    5.0
    """
    truth, mean = outcome.poses.relative
    distances = np.asarray(np.linalg.norm(mean - truth, axis=2))
    return _over_joints(distances, outcome.poses.hidden_relative)


@metric(
    title="Joint position error in space (global MPJPE), cm",
    direction=Direction.LOWER,
    sentence=(
        "Mean distance of predicted joints from true ones in space; errors of the root’s steps "
        "add up along a gap."
    ),
    unit="cm",
    range="0 to ∞",
    source="Ionescu et al. 2014",
    defined=has_poses,
)
def mpjpe_global(outcome: Imputation) -> Score:
    r"""Return the mean distance of predicted from true joints in space.

    It is the mean of ‖p̂_tj − p_tj‖ over the joints and frames whose position depends on a hidden
    entry. Where the root's translation is given as differences, it is summed up from the first
    frame of the recording, so that its errors accumulate along a gap; after the gap they are not
    scored.

    Parameters
    ----------
    outcome : Imputation
        With poses of J joints over N frames.

    Returns
    -------
    Score
        With parts ``"joint"`` (J,) and ``"frame"`` (N,), the means over the hidden joints of each.

    Raises
    ------
    ValueError
        As `mpjpe`.

    Warnings
    --------
    One wrong step of the root shifts all that follows in the gap, so that the root's path can hide
    how well the pose is filled: ``mpjpe`` leaves the root's path out.

    Notes
    -----
    With H the joints and frames that count:

    .. math:: \frac{1}{|H|} \sum_{(t, j) \in H} \| \hat p_{tj} - p_{tj} \|

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, ImputedPoses, mpjpe_global
    >>> truth, mean = np.zeros((2, 1, 2, 3))
    >>> mean[0, 1] = [3.0, 4.0, 0.0]
    >>> hidden = np.tile([False, True], (1, 1))
    >>> times = np.arange(1) / 30
    >>> poses = ImputedPoses(truth, mean, hidden, hidden, ("root", "knee"), (-1, 0), times)
    >>> outcome = Imputation(
    ...     truth=truth[:, 1],
    ...     mean=mean[:, 1],
    ...     variance=None,
    ...     hidden=np.full((1, 3), True),
    ...     visible_mean=np.zeros(3),
    ...     visible_variance=np.ones(3),
    ...     place_joints=lambda: poses,
    ... )
    >>> mpjpe_global(outcome).value
    5.0
    """
    return _over_joints(outcome.poses.errors, outcome.poses.hidden)


@metric(
    title="Bone length error, cm",
    direction=Direction.LOWER,
    sentence=(
        "Mean difference of predicted from true bone lengths, at hidden joints; defined where "
        "channels are positions."
    ),
    unit="cm",
    range="0 to ∞",
    source="this project",
    defined=_are_positions,
)
def bone_length_error(outcome: Imputation) -> Score:
    r"""Return the mean absolute difference of the lengths of predicted and true bones.

    It is the mean of ``|ℓ̂_tj − ℓ_tj|`` over the bones and frames with a hidden joint at either
    end, with ℓ_tj the distance of joint j from its parent at frame t. It is defined where the
    outputs are positions; joint angles keep all lengths.

    Parameters
    ----------
    outcome : Imputation
        With poses of J joints over N frames.

    Returns
    -------
    Score
        NaN if the root is the only joint. With parts ``"joint"`` (J,), by the joint at the far end
        of the bone, and ``"frame"`` (N,).

    Raises
    ------
    ValueError
        As `mpjpe`.

    Warnings
    --------
    Right lengths are not a right pose: a limb that points the wrong way can have an error of 0.

    Notes
    -----
    With π(j) the joint that j hangs from, and H the bones and frames that count:

    .. math::

        \frac{1}{|H|} \sum_{(t, j) \in H}
        \Bigl| \| \hat p_{tj} - \hat p_{t \pi(j)} \| - \| p_{tj} - p_{t \pi(j)} \| \Bigr|

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, ImputedPoses, bone_length_error
    >>> truth, mean = np.zeros((2, 1, 2, 3))
    >>> truth[0, 1], mean[0, 1] = [3.0, 4.0, 0.0], [0.0, 0.0, 7.0]
    >>> hidden = np.tile([False, True], (1, 1))
    >>> times = np.arange(1) / 30
    >>> poses = ImputedPoses(truth, mean, hidden, hidden, ("root", "knee"), (-1, 0), times)
    >>> outcome = Imputation(
    ...     truth=truth[:, 1],
    ...     mean=mean[:, 1],
    ...     variance=None,
    ...     hidden=np.full((1, 3), True),
    ...     visible_mean=np.zeros(3),
    ...     visible_variance=np.ones(3),
    ...     place_joints=lambda: poses,
    ... )
    >>> bone_length_error(outcome).value
    2.0
    """
    poses = outcome.poses
    parents = np.array(poses.parents)
    is_bone = parents >= 0
    truth, mean = (_lengths(places, parents) for places in (poses.truth, poses.mean))
    return _over_joints(np.abs(mean - truth), (poses.hidden | poses.hidden[:, parents]) & is_bone)


def _lengths(positions: NDArray[np.float64], parents: NDArray[np.intp]) -> Array:
    return np.asarray(np.linalg.norm(positions - positions[:, parents], axis=2))


def _over_joints(values: Array, hidden: Mask) -> Score:
    parts = {
        "joint": mean_over(values, hidden, axis=0),
        "frame": mean_over(values, hidden, axis=1),
    }
    return Score(float(values[hidden].mean()) if hidden.any() else float("nan"), parts)
