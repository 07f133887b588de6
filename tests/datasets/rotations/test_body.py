"""Where rotation vectors put the joints, by laws and beside forward kinematics of joint angles."""

import numpy as np
import pytest

from mocapbench.datasets import (
    PREDICTED,
    complete_joints,
    joint_positions,
    open_archive,
    place_rotated_joints,
    rotation_skeleton,
    rotations_of,
)
from mocapbench.datasets.rotations.body import JOINTS, PARENTS, coincident_joints

COLUMNS = [JOINTS.index(name) for name in PREDICTED]


@pytest.fixture(scope="module")
def turned():
    """Return 20 rows of any rotations of the joints that the contest's skeleton turns."""
    rng = np.random.default_rng(0)
    values = rng.normal(size=(20, 117))
    for joint in ("LHipJoint", "RHipJoint"):
        at = 3 + 3 * JOINTS.index(joint)
        values[:, at : at + 3] = 0.0
    return values


def test_the_root_stays_put_and_faces_one_way(turned):
    moved = turned.copy()
    moved[:, :6] += 1.0
    np.testing.assert_array_equal(place_rotated_joints(moved), place_rotated_joints(turned))
    assert not place_rotated_joints(turned)[:, 0].any()


def test_bones_keep_their_lengths(turned):
    joints = place_rotated_joints(turned)
    lengths = np.linalg.norm(joints[:, 1:] - joints[:, list(PARENTS[1:])], axis=2)
    expected = [segment.length for segment in rotation_skeleton().segments[1:]]
    np.testing.assert_allclose(lengths, np.tile(expected, (20, 1)), atol=1e-5)


def test_a_quarter_about_z_takes_x_to_y_and_carries_what_hangs_from_the_joint():
    values = np.zeros((1, 117))
    at = 3 + 3 * JOINTS.index("LeftArm")
    values[0, at + 2] = -np.pi / 2  # points are rows
    rest, turned = (place_rotated_joints(rows)[0] for rows in (np.zeros((1, 117)), values))
    shoulder, elbow, wrist = (JOINTS.index(f"Left{name}") for name in ("Arm", "ForeArm", "Hand"))
    np.testing.assert_allclose(turned[shoulder], rest[shoulder], atol=1e-12)
    for joint in (elbow, wrist):
        x, y, z = rest[joint] - rest[shoulder]
        np.testing.assert_allclose(turned[joint] - rest[shoulder], [-y, x, z], atol=1e-5)


def test_seven_joints_coincide_with_another_and_six_never_move(turned):
    joints, shown_by = place_rotated_joints(turned), coincident_joints()
    fixed = np.flatnonzero(np.ptp(joints, axis=0).max(axis=1) < 1e-12)
    assert fixed.tolist() == np.flatnonzero(shown_by < 0).tolist() == [0, 1, 2, 7, 8, 13]
    counts = np.bincount(shown_by[shown_by >= 0], minlength=len(PREDICTED))
    several = {PREDICTED[joint]: int(counts[joint]) for joint in np.flatnonzero(counts > 1)}
    assert several == {"Spine1": 4, "LeftHand": 3, "RightHand": 3}


def test_all_joints_follow_from_those_that_are_predicted(turned):
    joints = place_rotated_joints(turned)
    np.testing.assert_allclose(complete_joints(joints[:, COLUMNS]), joints, atol=1e-12)


def test_on_a_skeleton_of_the_database_joints_are_where_joint_angles_put_them():
    """But for the lengths, which are subject 02's: directions of bones are compared."""
    archive = open_archive()
    walk, skeleton = archive.recording("gait:01_01"), archive.skeleton("gait:01_01")
    still = {"root.tx", "root.ty", "root.tz", "root.rx", "root.ry", "root.rz"}
    posed = walk.select([name for name in walk.channels if name not in still])
    placed = joint_positions(skeleton, posed)
    joints = place_rotated_joints(rotations_of(walk, skeleton).values[1:])
    names = [segment.name for segment in skeleton.segments]
    for carrier, end, bone in (
        ("LeftUpLeg", "LeftLeg", "lfemur"),
        ("RightLeg", "RightFoot", "rtibia"),
        ("RightArm", "RightForeArm", "rhumerus"),
    ):
        at = names.index(bone)
        turned = joints[:, JOINTS.index(end)] - joints[:, JOINTS.index(carrier)]
        expected = placed[:, at] - placed[:, skeleton.parents[at]]
        one, other = (v / np.linalg.norm(v, axis=1, keepdims=True) for v in (turned, expected))
        direction = np.array(skeleton.segments[at].direction)
        offset = np.array(rotation_skeleton().segments[JOINTS.index(end)].direction)
        assert np.abs(one - other).max() < 2 * np.abs(direction - offset).max() + 1e-4
