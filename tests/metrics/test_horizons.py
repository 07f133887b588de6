"""Errors so many frames after the last visible one."""

import numpy as np
import pytest

from mocapbench.benchmark import METRICS
from mocapbench.metrics import Imputation, ImputedPoses
from mocapbench.metrics.horizons import HORIZONS


def continued(n_hidden=25, n_windows=3, n_joints=4, hide=None):
    """Return windows of ten visible frames, and what follows, whose error is k mm at frame k.

    The error is that of each joint in each window, times one more than the number of the window.
    """
    length = 10 + n_hidden
    frames = np.tile(np.arange(length), n_windows)
    hidden = frames >= 10
    if hide is not None:
        hidden = hide(frames)
    errors = np.where(hidden, frames - 9, 0) * np.repeat(np.arange(1, n_windows + 1), length) / 10
    truth = np.random.default_rng(0).normal(size=(len(frames), n_joints, 3))
    mean = truth.copy()
    mean[..., 1] += errors[:, None]
    mask = np.repeat(hidden[:, None], n_joints, axis=1)
    poses = ImputedPoses(
        truth,
        mean,
        mask,
        mask,
        tuple("abcd"[:n_joints]),
        (-1, 0, 1, 2)[:n_joints],
        frames / 60,
        tuple(range(0, len(frames), length)),
    )
    return Imputation(
        truth=truth.reshape(len(frames), -1),
        mean=mean.reshape(len(frames), -1),
        variance=None,
        hidden=np.repeat(mask, 3, axis=1),
        visible_mean=np.zeros(3 * n_joints),
        visible_variance=np.ones(3 * n_joints),
        place_joints=lambda: poses,
    )


@pytest.mark.parametrize("frame", HORIZONS)
def test_the_error_is_that_of_one_frame_in_mm_averaged_over_windows(frame):
    score = METRICS.get(f"mpjpe_at_{frame}")(continued())
    assert score.value == pytest.approx(frame * np.mean([1, 2, 3]))
    np.testing.assert_allclose(score.parts["joint"], score.value)


def test_joints_that_are_right_count_as_others_do():
    outcome = continued(n_windows=1)
    mean = outcome.poses.mean.copy()
    mean[:, 1:] = outcome.poses.truth[:, 1:]
    poses = ImputedPoses(
        outcome.poses.truth,
        mean,
        np.zeros_like(outcome.poses.hidden),  # as of joints that nothing hidden moves
        outcome.poses.hidden,
        outcome.poses.joints,
        outcome.poses.parents,
        outcome.poses.times,
    )
    object.__setattr__(outcome, "place_joints", lambda: poses)
    del outcome.__dict__["poses"]
    assert METRICS.get("mpjpe_at_8")(outcome).value == pytest.approx(8 / 4)


def test_it_is_defined_where_as_many_frames_are_hidden_at_every_end():
    metric = METRICS.get("mpjpe_at_10")
    assert metric.applies(continued(n_hidden=10))
    assert not metric.applies(continued(n_hidden=9))
    assert not metric.applies(continued(hide=lambda frames: (frames > 9) & (frames < 34)))
    assert not metric.applies(continued(hide=lambda frames: (frames > 9) & (frames != 30)))
