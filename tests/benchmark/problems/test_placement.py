"""Poses of problems: what is hidden, what is scored, and that nothing visible is."""

import numpy as np
import pytest

from mocapbench.baselines import Prediction
from mocapbench.benchmark import (
    METRICS,
    ImputeProblem,
    JointAngles,
    SynthesiseProblem,
    Unit,
    hide_frames,
)
from mocapbench.datasets import GaitLibrary, joint_positions, root_differences

MOTION = GaitLibrary().motion("01_01")
SKELETON = MOTION.skeleton
WALK = root_differences(MOTION.recording("walk").frames(range(0, 200, 4)))
GAP = slice(10, 30)
JOINTS = [segment.name for segment in SKELETON.segments]


BODY = JointAngles(SKELETON)


def problem(hidden, body=BODY):
    return ImputeProblem.of_one(WALK, hidden, body=body)


def score(name, posed, mean):
    return METRICS.get(name)(posed.outcome((Prediction(mean),))).value


@pytest.fixture
def gap():
    return problem(hide_frames(10, 30, *WALK.values.shape))


def hidden_in(*channels):
    hidden = np.zeros(WALK.values.shape, dtype=bool)
    hidden[GAP, [WALK.channels.index(channel) for channel in channels]] = True
    return hidden


def test_whole_frames_hide_all_joints_and_the_root_not_from_itself(gap):
    poses = gap.outcome((Prediction(WALK.values),)).poses
    assert poses.hidden[GAP].all()
    assert poses.hidden_relative[GAP, 1:].all()
    assert not poses.hidden_relative[:, 0].any()
    assert poses.hidden.sum() == 20 * len(JOINTS)


def test_a_perfect_answer_has_no_error_and_the_jerk_of_the_truth(gap):
    assert score("mpjpe", gap, WALK.values) == 0.0
    assert score("mpjpe_global", gap, WALK.values) == 0.0
    assert score("jerk_ratio", gap, WALK.values) == 1.0


def test_a_wrong_step_of_the_root_is_an_error_in_space_alone(gap):
    mean = WALK.values.copy()
    mean[GAP.start, WALK.channels.index("root.dtx")] += 1.0
    assert score("mpjpe", gap, mean) == pytest.approx(0.0, abs=1e-9)
    # Every frame of the gap but its first comes after the step.
    expected = SKELETON.centimetres_per_unit * 19 / 20
    assert score("mpjpe_global", gap, mean) == pytest.approx(expected)


def test_only_what_hangs_on_a_hidden_angle_is_scored():
    posed = problem(hidden_in("lhumerus.rx"))
    poses = posed.outcome((Prediction(WALK.values + 10.0),)).poses
    scored = {JOINTS[index] for index in np.flatnonzero(poses.hidden.any(axis=0))}
    assert scored == {"lhumerus", "lradius", "lwrist", "lhand", "lfingers", "lthumb"}
    np.testing.assert_array_equal(poses.hidden, poses.hidden_relative)


def test_what_an_answer_says_of_visible_entries_does_not_count():
    hidden = hidden_in("rfemur.rx", "root.ry")
    mean = np.where(hidden, WALK.values + 3.0, WALK.values)
    elsewhere = np.where(hidden, mean, 1e3)
    for name in ("mpjpe", "mpjpe_global", "jerk_ratio"):
        assert score(name, problem(hidden), elsewhere) == score(name, problem(hidden), mean)


def test_scores_in_another_unit_leave_positions_in_centimetres():
    hidden = hidden_in("rfemur.rx")
    posed = problem(hidden)
    scaled = ImputeProblem(
        posed.train, posed.given, posed.truth, Unit(np.ones(62), np.full(62, 9.0)), posed.body
    )
    mean = WALK.values + 3.0
    assert score("mpjpe", scaled, mean) == score("mpjpe", posed, mean)
    assert scaled.outcome((Prediction(mean),)).units == ("",) * 62
    assert set(posed.outcome((Prediction(mean),)).units) == {"deg", ""}


def test_several_recordings_are_placed_each_by_itself(gap):
    both = ImputeProblem(gap.train, gap.given * 2, gap.truth * 2, gap.unit, gap.body)
    solutions = (Prediction(WALK.values), Prediction(WALK.values + 1.0))
    poses = both.outcome(solutions).poses
    assert poses.starts == (0, 50)
    np.testing.assert_array_equal(poses.truth[:50], poses.truth[50:])
    np.testing.assert_array_equal(poses.mean[:50], poses.truth[:50])


def test_without_a_body_metrics_of_joints_do_not_apply(gap):
    outcome = problem(~gap.given[0].visible, body=None).outcome((Prediction(WALK.values),))
    assert not METRICS.get("mpjpe").applies(outcome)
    assert METRICS.get("mse").applies(outcome)


def test_samples_and_references_are_placed_on_one_body():
    path = MOTION.recording("walk").frames(range(0, 200, 4))
    posed = SynthesiseProblem((path,), path.times, 2, (path.values,), body=JointAngles(SKELETON))
    poses = posed.outcome(np.stack([path.values, path.values + 1.0])).poses
    expected = joint_positions(SKELETON, path)
    np.testing.assert_allclose(poses.samples[0], expected)
    np.testing.assert_allclose(poses.references[0], expected)
    assert poses.samples.shape == (2, 50, 31, 3)
