"""Errors of in-betweening: one distance a frame, over all joints."""

from dataclasses import replace

import numpy as np
import pytest

from mocapbench.metrics import l2p, l2q, rms_per_frame
from mocapbench.metrics.in_betweening import QUATERNION


def test_rotations_are_one_distance_a_frame_over_all_joints(make):
    truth = np.tile([1.0, 0.0, 0.0, 0.0], (3, 2))
    mean = truth.copy()
    mean[1, :4], mean[1, 4:], mean[2, 4:] = (
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        -truth[0, :4],
    )
    hidden = np.repeat([[False], [True], [True]], 8, axis=1)
    outcome = make(truth, mean, hidden=hidden, units=(QUATERNION,) * 8)
    assert l2q(outcome).value == pytest.approx((2.0 + 2.0) / 2)
    assert l2q(outcome).value == rms_per_frame(outcome).value


def test_outputs_that_are_no_rotations_have_no_such_error(make):
    outcome = make(np.zeros((2, 4)), np.ones((2, 4)))
    assert not l2q.applies(outcome)
    with pytest.raises(ValueError, match="expected outputs that are quaternions"):
        l2q(outcome)


def test_positions_are_one_distance_a_frame_of_coordinates_over_their_spread(pose):
    truth, mean = np.zeros((2, 3, 3, 3))
    mean[1, 1], mean[2, 2] = [3.0, 8.0, 0.0], [0.0, 0.0, 10.0]
    hidden = np.array([[False] * 3, [False, True, True], [False, True, True]])
    outcome = pose(truth, mean, hidden)
    placed = outcome.poses
    spread = np.ones((3, 3))
    spread[1, 1], spread[2, 2] = 2.0, 5.0
    outcome = replace(outcome, place_joints=lambda: replace(placed, spread=spread))
    assert l2p(outcome).value == pytest.approx((5.0 + 2.0) / 2)


def test_poses_without_a_spread_have_no_such_error(pose):
    outcome = pose(np.zeros((2, 3, 3)))
    assert not l2p.applies(outcome)
    with pytest.raises(ValueError, match="expected the standard deviations"):
        l2p(outcome)
