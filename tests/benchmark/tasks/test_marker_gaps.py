"""The gaps of marker-gaps: as long as declared, the same for all, and never at an end."""

import os

import numpy as np
import pytest

from mocapbench.baselines import CubicSplineImputer, Prediction
from mocapbench.benchmark import METRICS, TASKS
from mocapbench.benchmark.tasks.marker_gaps import LIMBS, N_BESIDE, RATE, SECONDS

TASK = TASKS.get("marker-gaps")
SYNTHETIC = [case for case in TASK.cases if case.synthetic]
N_JOINTS = {"one joint": 1, "five joints": 5, "three gaps": 3}


def hidden_joints(problem):
    """Return the hidden frames of each joint that has any, by its name."""
    (given,) = problem.given
    frames = {}
    for column in np.flatnonzero(~given.visible.all(axis=0)):
        joint = given.channels[column].partition(".")[0]
        frames.setdefault(joint, []).append(np.flatnonzero(~given.visible[:, column]).tolist())
    assert all(coordinates == [coordinates[0]] * 3 for coordinates in frames.values())
    return {joint: coordinates[0] for joint, coordinates in frames.items()}


def check_gaps(problem, case):
    (given,) = problem.given
    joints = hidden_joints(problem)
    length = round(RATE * case.columns["seconds"])
    for frames in joints.values():
        assert frames == list(range(frames[0], frames[0] + length))
        assert N_BESIDE <= frames[0] < frames[-1] < len(given.times) - N_BESIDE
    assert "root" not in joints
    place = case.columns["hidden"]
    if place == "a limb":
        assert set(joints) in [set(limb) for limb in LIMBS.values()]
    else:
        assert len(joints) == N_JOINTS[place]
    np.testing.assert_allclose(np.diff(given.times), 1 / RATE)


@pytest.mark.parametrize("case", [case.name for case in SYNTHETIC])
@pytest.mark.parametrize("fold", [0, 1])
def test_gaps_of_generated_motion_are_as_long_as_declared(posed, case, fold):
    check_gaps(posed("marker-gaps", case, fold), TASK.case(case))


@pytest.mark.slow
@pytest.mark.recordings
@pytest.mark.skipif("MOCAPBENCH_DATA" not in os.environ, reason="names no recordings")
@pytest.mark.parametrize("fold", range(4))
def test_gaps_of_recordings_are_as_long_as_declared(posed, fold):
    for case in TASK.cases:
        if not case.synthetic and case.columns["seconds"] in {0.1, 2.0}:
            check_gaps(posed("marker-gaps", case.name, fold), case)


def test_rows_that_differ_in_length_or_training_hide_the_same_joints(posed):
    problems = [posed("marker-gaps", case.name, 1) for case in SYNTHETIC]
    assert len({tuple(hidden_joints(problem)) for problem in problems}) == 1
    assert sorted({len(problem.train) for problem in problems}) == [1, 4]
    masks = {
        case.columns["seconds"]: (~problem.given[0].visible).tobytes()
        for case, problem in zip(SYNTHETIC, problems, strict=True)
    }
    assert sorted(masks) == sorted(SECONDS)
    for case, problem in zip(SYNTHETIC, problems, strict=True):
        assert (~problem.given[0].visible).tobytes() == masks[case.columns["seconds"]]


def test_folds_hide_other_joints_or_times(posed):
    case = SYNTHETIC[0].name
    gaps = {str(hidden_joints(posed("marker-gaps", case, fold))) for fold in range(8)}
    assert len(gaps) > 4


def test_models_see_neither_the_truth_nor_their_own_recording_twice(posed):
    problem = posed("marker-gaps", SYNTHETIC[-1].name)
    names = [recording.name for recording in problem.train]
    assert len(set(names)) == len(names)
    (own,) = [recording for recording in problem.train if recording.name == problem.given[0].name]
    np.testing.assert_array_equal(own.values, problem.given[0].values)


def test_the_root_stays_where_it_is_on_the_floor(posed):
    problem = posed("marker-gaps", SYNTHETIC[0].name)
    floor = problem.given[0].select(["root.x", "root.z"])
    np.testing.assert_array_equal(floor.values, 0.0)


def test_a_perfect_answer_has_no_error_and_rigid_bones(posed):
    problem = posed("marker-gaps", SYNTHETIC[1].name)
    spline = problem.solve(CubicSplineImputer().fit(problem.train), 0)
    perfect = (Prediction(problem.truth[0]),)
    expected = {"mpjpe": 0.0, "mpjpe_global": 0.0, "bone_length_error": 0.0, "jerk_ratio": 1.0}
    for name, value in expected.items():
        assert METRICS.get(name)(problem.outcome(perfect)).value == value
        assert METRICS.get(name)(problem.outcome(spline)).value != value
