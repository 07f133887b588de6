"""Jerk, the third derivative of position: how smooth a filled or sampled motion is."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.metrics.base import Direction, Score, has_poses, metric
from mocapbench.metrics.frames import runs_of_frames
from mocapbench.metrics.outcomes.imputation import Imputation
from mocapbench.metrics.outcomes.synthesis import Synthesis

__all__ = ["jerk_ratio", "sample_jerk_ratio"]


_WIDTH = 4
"""Frames of a third difference."""


@metric(
    title="Jerk, ratio to the truth",
    direction=Direction.TARGET,
    target=1.0,
    sentence=(
        "Jerk of filled joints over that of the true ones: below 1 too smooth, above 1 too rough."
    ),
    range="0 to ∞",
    source="this project",
    defined=has_poses,
)
def jerk_ratio(outcome: Imputation) -> Score:
    r"""Return the jerk of the prediction over that of the truth, within gaps.

    It is Σ‖ĵ‖ / Σ‖j‖, with j the jerk of a joint's position relative to the root over four frames
    in a row, 6 times the third divided difference over their times. The sums run over all joints
    and fours of frames in which the joint is hidden at least once, so that jumps at the ends of a
    gap count. Less than 1 is too smooth, more too rough.

    Parameters
    ----------
    outcome : Imputation
        With poses of J joints over N frames.

    Returns
    -------
    Score
        NaN if no joint that moves is hidden over four frames. With part ``"joint"`` (J,), the ratio
        of each.

    Raises
    ------
    ValueError
        If the outcome has no poses.

    Warnings
    --------
    A value of 1 does not make a fill right: a jump at the end of a gap can make up for a fill that
    is too smooth within. A third difference amplifies the noise of the recording, which a smooth
    fill rightly lacks.

    Notes
    -----
    With H the joints j and fours of frames t that count, and :math:`p_{tj}` positions relative to
    the root:

    .. math::

        \frac{\sum_{(t, j) \in H} \| \dddot{\hat p}_{tj} \|}
        {\sum_{(t, j) \in H} \| \dddot p_{tj} \|}

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, ImputedPoses, jerk_ratio
    >>> truth, mean = np.zeros((2, 5, 2, 3))
    >>> truth[:, 1, 0] = np.arange(5.0) ** 3
    >>> mean[:, 1, 0] = 0.5 * np.arange(5.0) ** 3
    >>> hidden = np.tile([False, True], (5, 1))
    >>> times = np.arange(5) / 30
    >>> poses = ImputedPoses(truth, mean, hidden, hidden, ("root", "knee"), (-1, 0), times)
    >>> outcome = Imputation(
    ...     truth=truth[:, 1],
    ...     mean=mean[:, 1],
    ...     variance=None,
    ...     hidden=np.full((5, 3), True),
    ...     visible_mean=np.zeros(3),
    ...     visible_variance=np.ones(3),
    ...     place_joints=lambda: poses,
    ... )
    >>> round(jerk_ratio(outcome).value, 6)
    0.5
    """
    poses = outcome.poses
    first = runs_of_frames(len(poses.times), poses.starts, _WIDTH)
    near = np.stack([poses.hidden_relative[first + k] for k in range(_WIDTH)]).any(axis=0)
    truth, mean = (
        np.where(near, _jerk(positions, poses.times, first), 0.0) for positions in poses.relative
    )
    by_joint = _ratio(mean.sum(axis=0), truth.sum(axis=0))
    return Score(float(_ratio(mean.sum(), truth.sum())), {"joint": by_joint})


@metric(
    title="Jerk, ratio to the references",
    direction=Direction.TARGET,
    target=1.0,
    sentence=(
        "Jerk of sampled joints over that of the references: below 1 too smooth, above 1 too rough."
    ),
    range="0 to ∞",
    source="this project",
    defined=has_poses,
)
def sample_jerk_ratio(outcome: Synthesis) -> Score:
    r"""Return the mean jerk of the samples over that of the references.

    It takes all joints relative to the root; jerk is as in `jerk_ratio`.

    Parameters
    ----------
    outcome : Synthesis
        With poses of S samples and M references.

    Returns
    -------
    Score
        NaN for fewer than four frames, or if the references do not move. With part ``"sample"``
        (S,).

    Raises
    ------
    ValueError
        If the outcome has no poses.

    Warnings
    --------
    Samples are drawn with the noise that the model found, which a third difference amplifies: a
    model with little more noise than the recording looks much too rough. Faster motion has more
    jerk, too.

    Notes
    -----
    With S samples s and M references m, sums over all joints j and fours of frames t:

    .. math::

        \frac{\frac{1}{S} \sum_s \sum_{t, j} \| \dddot p^{\,s}_{tj} \|}
        {\frac{1}{M} \sum_m \sum_{t, j} \| \dddot p^{\,m}_{tj} \|}

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import SampledPoses, Synthesis, sample_jerk_ratio
    >>> times = np.arange(5.0)
    >>> samples, references = np.zeros((2, 1, 5, 2, 3))
    >>> references[0, :, 1, 0] = times**3
    >>> samples[0, :, 1, 0] = 2.0 * times**3
    >>> poses = SampledPoses(samples, references, ("root", "knee"), times)
    >>> outcome = Synthesis(samples[:, :, 1], references[:, :, 1], lambda: poses)
    >>> round(sample_jerk_ratio(outcome).value, 6)
    2.0
    """
    poses = outcome.poses
    first = runs_of_frames(len(poses.times), (0,), _WIDTH)
    samples, references = (
        np.array([_jerk(each - each[:, :1], poses.times, first).sum() for each in motions])
        for motions in (poses.samples, poses.references)
    )
    by_sample = _ratio(samples, references.mean())
    return Score(float(by_sample.mean()), {"sample": by_sample})


def _jerk(positions: Array, times: Array, first: NDArray[np.intp]) -> Array:
    """Return the norm of the jerk (n, J) over four frames from each of ``first`` (n,)."""
    levels = [positions[first + k] for k in range(_WIDTH)]
    for order in range(1, _WIDTH):
        spans = [times[first + k + order] - times[first + k] for k in range(_WIDTH - order)]
        levels = [
            (after - before) / span[:, None, None]
            for before, after, span in zip(levels, levels[1:], spans, strict=False)
        ]
    return np.asarray(6.0 * np.linalg.norm(levels[0], axis=2))


def _ratio(numerator: Array, denominator: Array) -> Array:
    return np.asarray(numerator / np.where(denominator > 0.0, denominator, np.nan))
