"""Errors of positions: closed forms, what moves with what, and a loop."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.metrics import bone_length_error, mpjpe, mpjpe_global

N_FRAMES = 9
seeds = st.integers(0, 2**32 - 1)


def drawn(seed):
    """Return a truth and a prediction of the chain's joints, and a mask of joints."""
    rng = np.random.default_rng(seed)
    truth, mean = rng.normal(scale=30.0, size=(2, N_FRAMES, 3, 3))
    hidden = rng.random((N_FRAMES, 3)) < 0.5
    hidden[0] = [False, True, True]
    return truth, mean, hidden


def test_two_joints_by_hand(pose):
    truth = np.zeros((1, 3, 3))
    mean = np.array([[[0.0, 0.0, 0.0], [3.0, 4.0, 0.0], [3.0, 4.0, 12.0]]])
    outcome = pose(truth, mean)
    np.testing.assert_allclose(mpjpe(outcome).parts["joint"], [np.nan, 5.0, 13.0])
    assert mpjpe(outcome).value == mpjpe(outcome).parts["frame"] == 9.0
    np.testing.assert_allclose(bone_length_error(outcome).parts["joint"], [np.nan, 5.0, 12.0])


@given(seeds)
def test_a_perfect_prediction_has_no_error(pose, seed):
    truth, _, hidden = drawn(seed)
    for metric in (mpjpe, mpjpe_global, bone_length_error):
        assert metric(pose(truth, truth, hidden)).value == 0.0


@given(seeds)
def test_errors_equal_a_loop_over_hidden_joints(pose, seed):
    truth, mean, hidden = drawn(seed)
    outcome = pose(truth, mean, hidden)
    filled = outcome.poses.mean
    glob, relative, bones = [], [], []
    for t in range(N_FRAMES):
        for j in range(3):
            if hidden[t, j]:
                glob.append(np.linalg.norm(filled[t, j] - truth[t, j]))
            if hidden[t, j] and j > 0:
                moved = (filled[t, j] - filled[t, 0]) - (truth[t, j] - truth[t, 0])
                relative.append(np.linalg.norm(moved))
            if j > 0 and (hidden[t, j] or hidden[t, j - 1]):
                lengths = [np.linalg.norm(p[t, j] - p[t, j - 1]) for p in (filled, truth)]
                bones.append(abs(lengths[0] - lengths[1]))
    assert mpjpe_global(outcome).value == pytest.approx(np.mean(glob))
    assert mpjpe(outcome).value == pytest.approx(np.mean(relative))
    assert bone_length_error(outcome).value == pytest.approx(np.mean(bones))


@given(seeds, st.floats(0.1, 100.0))
def test_moving_the_whole_body_changes_the_error_in_space_alone(pose, seed, shift):
    truth, mean, _ = drawn(seed)
    whole = np.full((N_FRAMES, 3), True)
    moved = pose(truth, np.add(mean, [shift, 0.0, 0.0]), whole)
    assert mpjpe(moved).value == pytest.approx(mpjpe(pose(truth, mean, whole)).value)
    away = pose(truth, np.add(truth, [shift, 0.0, 0.0]), whole)
    assert mpjpe_global(away).value == pytest.approx(shift)
    assert mpjpe(away).value == pytest.approx(0.0, abs=1e-9)


@given(seeds)
def test_a_rigid_motion_keeps_bone_lengths(pose, seed):
    truth, _, _ = drawn(seed)
    turn, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    whole = np.full((N_FRAMES, 3), True)
    turned = pose(truth, truth @ turn + [5.0, 6.0, 7.0], whole)
    assert bone_length_error(turned).value == pytest.approx(0.0, abs=1e-9)
    assert mpjpe_global(turned).value > 0.1


def test_bone_lengths_count_only_where_outputs_are_positions(pose, draw):
    assert bone_length_error.applies(pose(np.zeros((1, 3, 3))))
    assert not bone_length_error.applies(draw(0))


def test_a_root_that_alone_is_hidden_has_no_error_relative_to_itself(pose):
    root = np.tile([True, False, False], (N_FRAMES, 1))
    outcome = pose(*drawn(0)[:2], root)
    assert np.isnan(mpjpe(outcome).value)
    assert mpjpe_global(outcome).value > 0.0


def test_poses_of_unlike_shapes_are_refused(pose):
    with pytest.raises(ValueError, match="expected positions and masks of"):
        pose(np.zeros((3, 3, 3)), hidden=np.full((2, 3), True))
