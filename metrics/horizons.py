"""Errors of joint positions so many frames after the last visible one, as contests print them."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from mocapbench.metrics.base import Direction, Metric, Score, has_poses, metric
from mocapbench.metrics.outcomes.imputation import Imputation

__all__ = [
    "HORIZONS",
    "mpjpe_at_2",
    "mpjpe_at_4",
    "mpjpe_at_8",
    "mpjpe_at_10",
    "mpjpe_at_14",
    "mpjpe_at_25",
]

HORIZONS = {2: 80, 4: 160, 8: 320, 10: 400, 14: 560, 25: 1000}
"""Frames after the last visible one, and what contests at 25 frames a second print of them, ms."""

_MM_PER_CM = 10.0


def _is_continued(outcome: Imputation, *, frame: int) -> bool:
    """Return whether joints can be placed, and so many frames are hidden at every end."""
    if not has_poses(outcome) or not outcome.hidden[-1].all():
        return False
    return bool((_count_hidden_at_ends(outcome) >= frame).all())


def _count_hidden_at_ends(outcome: Imputation) -> NDArray[np.intp]:
    """Return how many of the last frames of each recording are hidden as a whole."""
    parts = np.split(outcome.hidden.all(axis=1), outcome.poses.starts[1:])
    return np.array([np.logical_and.accumulate(part[::-1]).sum() for part in parts])


def _mean_distance(outcome: Imputation, *, frame: int) -> Score:
    r"""Return the mean distance of predicted from true joints at one frame after the last visible.

    It is the mean of ‖p̂_j − p_j‖ over all joints of the body, those included that cannot move, and
    over the recordings, at that frame of each and not up to it.

    Parameters
    ----------
    outcome : Imputation
        With poses of J joints; the last frames of every recording are hidden.
    frame : int
        Counted from 1, the first hidden one.

    Returns
    -------
    Score
        With part ``"joint"`` (J,).

    Raises
    ------
    ValueError
        If the outcome has no poses, or fewer frames are hidden at the end of a recording.

    Warnings
    --------
    Printed under a number of milliseconds that holds at 25 frames a second; the contests' files on
    the CMU database have 60. Joints that never move, of which papers' formulas say nothing, lower
    it, and coincident ones count several times.

    See Also
    --------
    mpjpe_at_2, mpjpe_at_4, mpjpe_at_8, mpjpe_at_10, mpjpe_at_14, mpjpe_at_25 : The horizons.
    mpjpe : The same over all hidden frames and the joints that something hidden moves, in cm.

    Notes
    -----
    With K recordings, J joints, and k frames after the last visible one, :math:`a_i`:

    .. math::

        \frac{1}{K J} \sum_{i = 1}^K \sum_{j = 1}^J
        \bigl\| \hat p^i_{a_i + k, j} - p^i_{a_i + k, j} \bigr\|

    References
    ----------
    Mao, Liu, Salzmann and Li (2019), Learning Trajectory Dependencies for Human Motion Prediction:
    its code, not its formula.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, ImputedPoses, mpjpe_at_2
    >>> truth, mean = np.zeros((2, 3, 2, 3))
    >>> mean[2, 1] = [3.0, 4.0, 0.0]
    >>> hidden = np.array([[False, False], [False, True], [False, True]])
    >>> times = np.arange(3) / 60
    >>> poses = ImputedPoses(truth, mean, hidden, hidden, ("root", "knee"), (-1, 0), times)
    >>> outcome = Imputation(
    ...     truth=truth[:, 1],
    ...     mean=mean[:, 1],
    ...     variance=None,
    ...     hidden=np.repeat(hidden[:, 1:], 3, axis=1),
    ...     visible_mean=np.zeros(3),
    ...     visible_variance=np.ones(3),
    ...     place_joints=lambda: poses,
    ... )
    >>> mpjpe_at_2(outcome).value
    25.0
    """
    if not _is_continued(outcome, frame=frame):
        raise ValueError(
            f"expected recordings whose last {frame} frames or more are hidden whole, got others; "
            "score them by mpjpe"
        )
    ends = np.array([*outcome.poses.starts[1:], len(outcome.hidden)])
    first_hidden = ends - _count_hidden_at_ends(outcome)
    distances = _MM_PER_CM * outcome.poses.errors[first_hidden + frame - 1]
    return Score(float(distances.mean()), {"joint": distances.mean(axis=0)})


def _declare_horizon(frame: int) -> Metric[Imputation]:
    declare = metric(
        title=f"Joint position error at frame {frame} (printed as {HORIZONS[frame]} ms), mm",
        direction=Direction.LOWER,
        sentence=(
            f"Mean distance of predicted joints from true ones {frame} frames after the last "
            "visible one, over all joints of the body."
        ),
        unit="mm",
        range="0 to ∞",
        source="Mao et al. 2019",
        defined=partial(_is_continued, frame=frame),
        name=f"mpjpe_at_{frame}",
    )
    return declare(partial(_mean_distance, frame=frame))


mpjpe_at_2: Metric[Imputation] = _declare_horizon(2)
mpjpe_at_4: Metric[Imputation] = _declare_horizon(4)
mpjpe_at_8: Metric[Imputation] = _declare_horizon(8)
mpjpe_at_10: Metric[Imputation] = _declare_horizon(10)
mpjpe_at_14: Metric[Imputation] = _declare_horizon(14)
mpjpe_at_25: Metric[Imputation] = _declare_horizon(25)
