"""Forward kinematics: laws of any skeleton, and known poses."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation

from mocapbench.datasets import Motion, Recording, joint_positions

angles = arrays(np.float64, (4, 12), elements=st.floats(-180, 180))


def posed(skeleton, values):
    return Motion(skeleton, tuple(skeleton.moving), values).recording("pose")


def bones(skeleton, joints):
    return joints[:, 1:] - joints[:, list(skeleton.parents[1:])]


@given(angles)
def test_segments_keep_their_length(skeleton, values):
    lengths = np.linalg.norm(
        bones(skeleton, joint_positions(skeleton, posed(skeleton, values))), axis=2
    )
    expected = [segment.length * 5.08 for segment in skeleton.segments[1:]]
    np.testing.assert_allclose(lengths, np.broadcast_to(expected, lengths.shape))


@given(angles, st.integers(1, 3))
def test_recordings_are_placed_together_as_each_by_itself(skeleton, values, cut):
    first, second = posed(skeleton, values[:cut]), posed(skeleton, values[cut:])
    second = second.select(second.channels[:5])
    together = joint_positions(skeleton, first, second)
    apart = [joint_positions(skeleton, recording) for recording in (first, second)]
    np.testing.assert_allclose(together, np.concatenate(apart), rtol=1e-12, atol=1e-9)


@given(angles)
def test_the_root_is_at_its_translation_in_centimetres(skeleton, values):
    joints = joint_positions(skeleton, posed(skeleton, values))
    np.testing.assert_allclose(joints[:, 0], values[:, :3] * 5.08, atol=1e-12)


@given(angles)
def test_turning_the_root_turns_the_body_rigidly(skeleton, values):
    upright = values.copy()
    upright[:, :6] = 0.0
    turned = values.copy()
    turned[:, :3] = 0.0
    rotation = Rotation.from_euler("xyz", values[:, 3:6], degrees=True)
    expected = np.stack(
        [
            rotation.apply(joint)
            for joint in joint_positions(skeleton, posed(skeleton, upright)).transpose(1, 0, 2)
        ],
        axis=1,
    )
    np.testing.assert_allclose(
        joint_positions(skeleton, posed(skeleton, turned)), expected, atol=1e-9
    )


def chained(skeleton, recording):
    """Return the positions, with every segment turned by C M C⁻¹ as scipy composes rotations."""
    curves = dict(zip(recording.channels, recording.values.T, strict=True))
    rest = np.zeros(len(recording.times))
    ends, turned = [], []
    for segment, parent in zip(skeleton.segments, skeleton.parents, strict=True):
        by_axis = [curves.get(f"{segment.name}.r{axis.lower()}", rest) for axis in segment.order]
        moved = Rotation.from_euler(segment.order.lower(), np.transpose(by_axis), degrees=True)
        axis = Rotation.from_euler("xyz", segment.axis, degrees=True)
        own = axis * moved * axis.inv()
        turned.append(turned[parent] * own if parent >= 0 else own)
        bone = turned[-1].apply(segment.length * np.asarray(segment.direction))
        root = np.transpose([curves[f"root.t{axis}"] for axis in "xyz"])
        ends.append(ends[parent] + bone if parent >= 0 else root)
    return np.stack(ends, axis=1) * skeleton.centimetres_per_unit


@given(angles)
def test_segments_are_turned_as_scipy_composes_rotations(skeleton, values):
    recording = posed(skeleton, values)
    np.testing.assert_allclose(
        joint_positions(skeleton, recording), chained(skeleton, recording), atol=1e-9
    )


def test_at_rest_segments_point_in_their_directions(skeleton):
    joints = joint_positions(skeleton, posed(skeleton, np.zeros((1, 12))))
    expected = [
        np.multiply(segment.direction, segment.length * 5.08) for segment in skeleton.segments[1:]
    ]
    np.testing.assert_allclose(bones(skeleton, joints)[0], expected, atol=1e-12)


def test_the_position_of_a_bent_knee_follows_from_trigonometry(skeleton):
    recording = Recording("bend", [0.0], [[90.0]], ("shin.rx",), ("deg",))
    hip, knee, ankle = joint_positions(skeleton, recording)[0, [1, 3, 4]] / 5.08
    np.testing.assert_allclose(knee - hip, [0, -7.5, 0], atol=1e-12)
    # The axis leans by 20° in the frontal plane, so the shin swings in a plane that leans too: its
    # part along that axis, sin 20°, stays, and the rest turns from down to backward.
    along = np.array([np.cos(np.radians(20)), np.sin(np.radians(20)), 0])
    down = np.array([0, -7.0, 0])
    expected = along * (along @ down) - np.array([0, 0, 7 * np.cos(np.radians(20))])
    np.testing.assert_allclose(ankle - knee, expected, atol=1e-12)


def test_degrees_of_freedom_without_a_channel_are_at_rest(skeleton):
    values = np.zeros((2, 12))
    values[:, 6:9] = [-20, 5, 1]
    channels = ("thigh.rz", "thigh.rx", "thigh.ry")
    some = Recording("some", [0.0, 1.0], [[1, -20, 5], [1, -20, 5]], channels, ("deg",) * 3)
    all_of_them = Motion(skeleton, ("root", "thigh", "arm", "shin"), values).recording("all")
    np.testing.assert_allclose(
        joint_positions(skeleton, some), joint_positions(skeleton, all_of_them)
    )


@pytest.mark.parametrize(("channel", "value"), [("wing.rx", 1.0), ("shin.rx", np.nan)])
def test_unknown_channels_and_hidden_entries_are_refused(skeleton, channel, value):
    recording = Recording("bad", [0.0], [[value]], (channel,), ("deg",))
    with pytest.raises(ValueError, match="complete frames of the skeleton"):
        joint_positions(skeleton, recording)


@pytest.mark.recordings
def test_a_real_walker_has_its_head_up_and_its_feet_on_the_floor(cmu):
    skeleton = cmu.skeleton("cmu:02_01")
    names = [segment.name for segment in skeleton.segments]
    joints = joint_positions(skeleton, cmu.recording("cmu:02_01"))
    assert (joints[:, names.index("head"), 1] > 140).all()
    lowest = joints[:, [names.index("ltoes"), names.index("rtoes")], 1].min(axis=1)
    assert (np.abs(lowest) < 8).all()
