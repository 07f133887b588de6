"""Feet that slide while they should stand."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.metrics.base import Direction, Score, has_poses, metric
from mocapbench.metrics.entries import mean_over
from mocapbench.metrics.frames import runs_of_frames
from mocapbench.metrics.outcomes.imputation import Imputation
from mocapbench.metrics.outcomes.synthesis import Synthesis

__all__ = ["foot_skate", "sample_foot_skate"]


CONTACT_HEIGHT = 5.0
"""Centimetres above its lowest place below which a true foot may stand."""
CONTACT_SPEED = 30.0
"""Centimetres per second below which it does."""
SKATE_HEIGHT = 2.5
"""Centimetres below which the speed of a sampled foot counts."""

_FOOT = "foot"
_HORIZONTAL = [0, 2]


@metric(
    title="Foot skate, cm/s",
    direction=Direction.LOWER,
    sentence=(
        "Mean horizontal speed of a filled foot while the true foot stands; recorded walks have 6 "
        "to 10 themselves."
    ),
    unit="cm/s",
    range="0 to ∞",
    source="this project",
    defined=has_poses,
)
def foot_skate(outcome: Imputation) -> Score:
    r"""Return the mean horizontal speed of predicted feet while the true feet stand.

    A foot is a joint whose name ends in ``foot``; in the Acclaim format it is placed at the ball of
    the foot. It stands from one frame to the next where the truth is below 5 cm at both, above its
    lowest place in the recording, and slower than 30 cm/s between them. The mean is over the feet
    and pairs of frames where it stands and is hidden at either frame. The truth itself does not
    have 0: recordings of the CMU database have 6 to 10 cm/s in walks and 10 to 15 in runs
    (docs/results/positions.md).

    Parameters
    ----------
    outcome : Imputation
        With poses over N frames.

    Returns
    -------
    Score
        NaN if no foot stands where it is hidden. With part ``"joint"`` (J,), NaN but for feet.

    Raises
    ------
    ValueError
        If the outcome has no poses or no feet.

    Warnings
    --------
    Only horizontal speed counts, and only while the true foot stands: a foot that floats in its
    place, or sinks into the ground, is not seen. Compare with the 6 to 10 cm/s of recordings, not
    with 0.

    Notes
    -----
    With C the feet f and pairs of frames (t, t + 1) that count, :math:`\Delta_t` the time between
    the two, and x and z the horizontal coordinates of predicted positions:

    .. math::

        \frac{1}{|C|} \sum_{(t, f) \in C} \frac{\bigl\|
        (\hat x, \hat z)_{t+1, f} - (\hat x, \hat z)_{t, f} \bigr\|}{\Delta_t}

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Imputation, ImputedPoses, foot_skate
    >>> truth, mean = np.zeros((2, 4, 2, 3))
    >>> mean[:, 1, 0] = [0.0, 1.0, 2.0, 3.0]
    >>> hidden = np.tile([False, True], (4, 1))
    >>> times = np.arange(4) / 30
    >>> poses = ImputedPoses(truth, mean, hidden, hidden, ("root", "foot"), (-1, 0), times)
    >>> outcome = Imputation(
    ...     truth=truth[:, 1],
    ...     mean=mean[:, 1],
    ...     variance=None,
    ...     hidden=np.full((4, 3), True),
    ...     visible_mean=np.zeros(3),
    ...     visible_variance=np.ones(3),
    ...     place_joints=lambda: poses,
    ... )
    >>> round(foot_skate(outcome).value, 6)
    30.0
    """
    poses = outcome.poses
    of_feet = _feet(poses.joints)
    first = runs_of_frames(len(poses.times), poses.starts, 2)
    truth, mean = poses.truth[:, of_feet], poses.mean[:, of_feet]
    seconds = np.diff(poses.times, append=np.inf)[first, None]
    low = _heights(truth, poses.starts) < CONTACT_HEIGHT
    slow = _steps(truth, first, [0, 1, 2]) < CONTACT_SPEED * seconds
    hidden = poses.hidden[:, of_feet]
    counts = low[first] & low[first + 1] & slow & (hidden[first] | hidden[first + 1])
    speeds = _steps(mean, first, _HORIZONTAL) / seconds
    by_joint = np.full(len(poses.joints), np.nan)
    by_joint[of_feet] = mean_over(speeds, counts, axis=0)
    return Score(float(speeds[counts].mean()) if counts.any() else np.nan, {"joint": by_joint})


@metric(
    title="Foot skate of samples, cm/s",
    direction=Direction.LOWER,
    sentence=(
        "Mean horizontal speed of sampled feet near the ground; recorded walks have 4 to 12 "
        "themselves."
    ),
    unit="cm/s",
    range="0 to ∞",
    source="Zhang et al. 2018",
    defined=has_poses,
)
def sample_foot_skate(outcome: Synthesis) -> Score:
    r"""Return the mean horizontal speed of sampled feet near the ground, weighted by nearness.

    It is the mean of v (2 − 2^(h/H)) over the feet and pairs of frames with h < H = 2.5 cm, v being
    the horizontal speed and h the height at the second frame above the lowest place of the sample's
    feet. Recordings of the CMU database have 4 to 12 cm/s in walks and 20 to 25 in runs
    (docs/results/positions.md).

    Parameters
    ----------
    outcome : Synthesis
        With poses of S samples.

    Returns
    -------
    Score
        With part ``"sample"`` (S,); NaN for a single frame.

    Raises
    ------
    ValueError
        If the outcome has no poses or no feet.

    Warnings
    --------
    The ground is the lowest place of the sample's own feet: one frame in which a foot is too low
    leaves few others near it. A motion that stands still has 0.

    Notes
    -----
    Of one sample, with C its feet and pairs of frames with :math:`h_t < H`; the value is the mean
    over samples:

    .. math:: \frac{1}{|C|} \sum_{(t, f) \in C} v_{tf} \, \bigl(2 - 2^{h_{tf} / H}\bigr)

    References
    ----------
    Zhang, Starke, Komura and Saito (2018), Mode-adaptive neural networks for quadruped motion
    control.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import SampledPoses, Synthesis, sample_foot_skate
    >>> times = np.arange(4) / 30
    >>> samples, references = np.zeros((2, 1, 4, 2, 3))
    >>> samples[0, :, 1, 0] = [0.0, 1.0, 2.0, 3.0]
    >>> poses = SampledPoses(samples, references, ("root", "foot"), times)
    >>> outcome = Synthesis(samples[:, :, 1], references[:, :, 1], lambda: poses)
    >>> round(sample_foot_skate(outcome).value, 6)
    30.0
    """
    poses = outcome.poses
    of_feet = _feet(poses.joints)
    by_sample = np.array([_skate(sample[:, of_feet], poses.times) for sample in poses.samples])
    return Score(
        float(np.nanmean(by_sample)) if len(poses.times) > 1 else np.nan, {"sample": by_sample}
    )


def _skate(positions: Array, times: Array) -> float:
    """Return the mean weighted speed of the feet (N, F, 3) of one motion."""
    first = runs_of_frames(len(times), (0,), 2)
    heights = _heights(positions, (0,))[first + 1]
    low = heights < SKATE_HEIGHT
    speeds = _steps(positions, first, _HORIZONTAL) / np.diff(times)[:, None]
    weighted = speeds * (2.0 - 2.0 ** (np.minimum(heights, SKATE_HEIGHT) / SKATE_HEIGHT))
    return float(weighted[low].mean()) if low.any() else float("nan")


def _heights(positions: Array, starts: tuple[int, ...]) -> Array:
    """Return heights (N, F) above the lowest place of any foot in the same recording."""
    heights = positions[..., 1]
    return np.concatenate([part - part.min() for part in np.split(heights, starts[1:])])


def _steps(positions: Array, first: NDArray[np.intp], axes: list[int]) -> Array:
    """Return the distances (n, F) from each of the frames ``first`` to the next along ``axes``."""
    return np.asarray(np.linalg.norm((positions[first + 1] - positions[first])[..., axes], axis=2))


def _feet(joints: tuple[str, ...]) -> list[int]:
    """Return the indices of the joints whose name ends in ``foot``.

    Raises
    ------
    ValueError
        If there is none.
    """
    found = [index for index, name in enumerate(joints) if name.lower().endswith(_FOOT)]
    if not found:
        raise ValueError(
            f"expected joints whose names end in {_FOOT!r}, got {', '.join(joints)}: rename them, "
            "or leave metrics of feet out"
        )
    return found
