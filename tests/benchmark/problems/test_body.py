"""Bodies: what moves which joint, and that positions follow from values either way."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.benchmark import JointAngles, JointPositions
from mocapbench.datasets import (
    GaitLibrary,
    gpdm_features,
    joint_positions,
    joint_trajectories,
    position_channels,
    root_differences,
)

MOTION = GaitLibrary().motion("01_01")
SKELETON = MOTION.skeleton
WALK = MOTION.recording("walk").frames(range(0, 120, 30))
ANGLES, POSITIONS = JointAngles(SKELETON), JointPositions(SKELETON)
MARKERS = joint_trajectories(SKELETON, WALK)


@pytest.mark.parametrize(("body", "recording"), [(ANGLES, WALK), (POSITIONS, MARKERS)])
@settings(max_examples=20)
@given(data=st.data())
def test_a_joint_depends_on_a_channel_if_and_only_if_it_moves_with_it(body, recording, data):
    channel = data.draw(st.integers(0, len(recording.channels) - 1))
    changed = recording.values.copy()
    changed[:, channel] += 10.0
    before, after = body.positions(recording), body.positions(recording.with_values(changed))
    moved = (np.abs(after - before) > 1e-6).any(axis=(0, 2))
    depends = body.dependence(recording.channels)[:, channel]
    assert not (moved & ~depends).any()
    # A turn about the axis of a bone moves nothing but what hangs on it.
    assert moved.any() or recording.channels[channel].endswith(("rx", "ry", "rz"))


def test_the_joints_own_coordinates_are_its_positions():
    np.testing.assert_array_equal(POSITIONS.positions(MARKERS), joint_positions(SKELETON, WALK))
    shuffled = MARKERS.select(MARKERS.channels[::-1])
    np.testing.assert_array_equal(POSITIONS.positions(shuffled), POSITIONS.positions(MARKERS))
    assert MARKERS.channels == position_channels(SKELETON)
    assert set(MARKERS.units) == {"cm"}


def test_steps_of_the_root_are_summed_up_from_the_origin():
    stepwise = ANGLES.positions(root_differences(WALK))
    path = ANGLES.positions(WALK)
    np.testing.assert_allclose(stepwise - stepwise[:1, :1], path - path[:1, :1], atol=1e-9)
    np.testing.assert_allclose(stepwise[0, 0], 0.0)


def test_channels_that_a_paper_leaves_out_are_in_the_rest_pose():
    fewer = ANGLES.positions(gpdm_features(MOTION.recording("walk")))
    assert fewer.shape[1:] == (31, 3)
    assert np.isfinite(fewer).all()


def test_a_missing_coordinate_is_named():
    with pytest.raises(ValueError, match=r"no channels \['root.y'\]"):
        POSITIONS.positions(MARKERS.select([c for c in MARKERS.channels if c != "root.y"]))
