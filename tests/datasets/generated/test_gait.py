"""The synthetic walker: deterministic, on the database's channels, and walking."""

import os
import subprocess
import sys
from itertools import product

import numpy as np
import pytest

from mocapbench.datasets import (
    THESIS_CHANNELS,
    GaitLibrary,
    format_motion,
    format_skeleton,
    gait_style,
    gpdm_features,
    joint_positions,
    parse_motion,
    parse_skeleton,
)

KEYS = ["01_01", "03_03", "05_04", "08_05"]


@pytest.fixture(scope="module")
def motions():
    return {key: GaitLibrary().motion(key) for key in KEYS}


def joints_of(motion):
    names = [segment.name for segment in motion.skeleton.segments]
    positions = joint_positions(motion.skeleton, motion.recording("gait"))
    return dict(zip(names, positions.transpose(1, 0, 2), strict=True))


def test_the_channels_are_those_of_the_database(motions):
    for motion in motions.values():
        assert len(motion.segments) == 29
        assert len(motion.channels) == 62
        assert set(THESIS_CHANNELS) < set(motion.channels)
        assert gpdm_features(motion.recording("gait")).values.shape[1] == 50
        assert 300 <= len(motion.values) <= 360


def test_a_key_names_one_motion(motions):
    for key, motion in motions.items():
        np.testing.assert_array_equal(GaitLibrary().motion(key).values, motion.values)


def test_as_acclaim_text_a_motion_has_the_same_values(motions):
    for motion in motions.values():
        back = parse_motion(format_motion(motion), motion.skeleton, "gait")
        assert (back.segments, back.values.flags.c_contiguous) == (motion.segments, True)
        assert back.values.tobytes() == motion.values.tobytes()


def test_subjects_and_trials_differ():
    library = GaitLibrary()
    starts = [
        tuple(library.motion(f"{subject:02}_{trial:02}").values[0])
        for subject, trial in product(range(1, 9), range(1, 4))
    ]
    assert len(set(starts)) == 24


def test_the_version_identifies_the_numbers(motions):
    # If this fails and the motion was meant to change, raise GAIT_VERSION with the new numbers.
    values = motions["01_01"].values
    assert GaitLibrary().digest("01_01") == "gait-1:01_01"
    np.testing.assert_allclose(
        [values[0, 5], values[100, 2], np.abs(values).mean()],
        [1.7607911680727781, 16.231855960987502, 7.481371513123987],
        rtol=0,
        atol=1e-9,
    )


def test_trials_go_through_the_styles():
    assert [gait_style(f"01_{trial:02}") for trial in range(1, 7)] == [
        *("walk", "walk", "slow walk", "stride", "run", "walk")
    ]


def test_legs_alternate_and_arms_swing_against_them(motions):
    for motion in motions.values():
        joints = joints_of(motion)
        legs = joints["lfoot"][:, 2] - joints["rfoot"][:, 2]
        arms = joints["lhand"][:, 2] - joints["rhand"][:, 2]
        assert legs.max() > 20
        assert legs.min() < -20
        assert np.corrcoef(legs, arms)[0, 1] < -0.5


def test_knees_bend_backward_only(motions):
    for motion in motions.values():
        joints = joints_of(motion)
        for side in "lr":
            hip, knee, ankle = (joints[side + name] for name in ("hipjoint", "femur", "tibia"))
            normal = np.cross(knee - hip, ankle - knee)[:, 0]
            assert np.quantile(normal, 0.02) > -200  # cm²: about 7° of hyperextension


def test_feet_stay_near_the_floor_and_the_head_up(motions):
    for motion in motions.values():
        joints = joints_of(motion)
        lowest = np.min([joints[side + "toes"][:, 1] for side in "lr"], axis=0)
        assert lowest.min() > -4
        assert np.median(lowest) < 6
        assert joints["head"][:, 1].min() > 130


def test_the_root_advances_at_the_pace_of_the_style():
    library = GaitLibrary()
    speeds = [
        np.ptp(joints_of(library.motion(f"02_{trial:02}"))["root"][[0, -1], 2])
        / len(library.motion(f"02_{trial:02}").values)
        * 120
        for trial in (3, 1, 5)
    ]
    assert speeds == sorted(speeds)
    assert 40 < speeds[0] < speeds[-1] < 400


def test_a_standing_foot_hardly_slides(motions):
    joints = joints_of(motions["01_01"])
    slowest = np.min(
        [np.abs(np.gradient(joints[side + "foot"][:, 2])) * 120 for side in "lr"], axis=0
    )
    speed = np.ptp(joints["root"][[0, -1], 2]) / len(slowest) * 120
    assert np.median(slowest) < 0.25 * speed


def test_clavicles_and_fingers_do_not_move(motions):
    motion = motions["01_01"]
    still = np.ptp(motion.values, axis=0) == 0
    constant = [motion.channels[column] for column in np.flatnonzero(still)]
    assert {name.split(".")[0][1:] for name in constant} == {"clavicle", "fingers"}


def test_its_skeleton_is_the_same_after_writing_and_reading(motions):
    skeleton = motions["01_01"].skeleton
    assert parse_skeleton(format_skeleton(skeleton), "") == skeleton
    np.testing.assert_allclose(
        [np.linalg.norm(segment.direction) for segment in skeleton.segments[1:]], 1.0
    )


def test_a_malformed_key_is_refused():
    library = GaitLibrary()
    for method in (library.where, library.recording, library.motion, library.digest, library.fetch):
        with pytest.raises(ValueError, match="SUBJECT_TRIAL"):
            method("1_1")


@pytest.mark.slow
def test_recordings_do_not_depend_on_the_kernels_of_blas():
    """They have the name of a version in the place of a digest."""
    code = "from mocapbench.datasets import open_archive as a;" + (
        "import hashlib as h; print(*(h.sha256(a().recording(f'gait:{key}').values.tobytes())"
        f".hexdigest() for key in {KEYS}))"
    )
    digests = [
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "OPENBLAS_CORETYPE": kernel},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for kernel in ("Prescott", "Haswell")
    ]
    assert len(digests[0].split()) == len(KEYS)
    assert digests[0] == digests[1]
