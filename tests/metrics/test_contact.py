"""Feet: what stands and slides, and what is in the air or too fast to stand."""

import numpy as np
import pytest

from mocapbench.metrics import foot_skate, sample_foot_skate

N_FRAMES, RATE = 12, 30.0


def foot_at(height, speed=0.0):
    """Return a chain whose foot moves at a constant speed along z; its first frame is low."""
    joints = np.zeros((N_FRAMES, 3, 3))
    joints[1:, 2, 1] = height
    joints[:, 2, 2] = speed * np.arange(N_FRAMES) / RATE
    return joints


def test_a_foot_that_slides_while_the_true_one_stands_has_its_speed(pose):
    outcome = pose(foot_at(0.0), foot_at(0.0, speed=12.0))
    assert foot_skate(outcome).value == pytest.approx(12.0)
    np.testing.assert_allclose(foot_skate(outcome).parts["joint"], [np.nan, np.nan, 12.0])


def test_height_of_the_prediction_is_no_skate(pose):
    assert foot_skate(pose(foot_at(0.0), foot_at(50.0))).value == pytest.approx(0.0)


@pytest.mark.parametrize("truth", [foot_at(6.0), foot_at(0.0, speed=40.0)], ids=["high", "fast"])
def test_a_true_foot_in_the_air_or_on_the_move_does_not_count(pose, truth):
    assert np.isnan(foot_skate(pose(truth, foot_at(0.0, speed=12.0))).value)


def test_a_foot_that_stands_still_in_the_truth_scores_its_own_speed(pose):
    assert foot_skate(pose(foot_at(0.0, speed=7.0))).value == pytest.approx(7.0)


def test_a_visible_foot_does_not_count(pose):
    hidden = np.tile([False, True, False], (N_FRAMES, 1))
    assert np.isnan(foot_skate(pose(foot_at(0.0), foot_at(0.0, 12.0), hidden)).value)


def test_each_recording_has_its_own_ground(pose):
    high = np.add(foot_at(0.0), [0.0, 100.0, 0.0])
    both = np.concatenate([foot_at(0.0), high])
    slid = np.concatenate([foot_at(0.0), high + foot_at(0.0, speed=10.0)])
    times = np.tile(np.arange(N_FRAMES) / RATE, 2)
    score = foot_skate(pose(both, slid, times=times, starts=(0, N_FRAMES)))
    assert score.value == pytest.approx(5.0)


def test_a_sampled_foot_counts_less_the_higher_it_is(place):
    ground, above, high = (foot_at(height, speed=12.0) for height in (0.0, 1.25, 5.0))
    score = sample_foot_skate(place([ground, above], [ground]))
    np.testing.assert_allclose(score.parts["sample"], [12.0, 12.0 * (2.0 - 2.0**0.5)])
    alone = sample_foot_skate(place([ground, high], [ground]))
    assert np.isnan(alone.parts["sample"][1])
    assert alone.value == pytest.approx(12.0)


def test_a_skeleton_without_feet_is_named(pose):
    outcome = pose(foot_at(0.0))
    object.__setattr__(outcome.poses, "joints", ("root", "knee", "toe"))
    with pytest.raises(ValueError, match="names end in 'foot', got root, knee, toe"):
        foot_skate(outcome)
