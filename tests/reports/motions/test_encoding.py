"""Positions come back from text to within half the resolution."""

import zlib
from base64 import b64decode

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.datasets import GaitLibrary, joint_positions
from mocapbench.reports import Motions
from mocapbench.reports.motions.encoding import FINEST, encode, resolution

PARENTS = (-1, 0, 1, 0)
SHAPE = (5, len(PARENTS), 3)
POSITIONS = arrays(float, SHAPE, elements=st.floats(-1e4, 1e4, width=32))


def picture(truth, *made, parents=PARENTS):
    joints = tuple(map(str, range(len(parents))))
    motions = {str(k): positions for k, positions in enumerate(made)}
    hidden = np.zeros(len(truth), dtype=bool)
    return Motions("task", "t", "c", 0.1, joints, parents, hidden, {"truth": truth}, motions, "0")


def decoded(text, shown):
    """Return what a reader of the format's description makes of the text, (M, T, J, 3)."""
    planes = np.frombuffer(zlib.decompress(b64decode(text)), dtype=np.uint8).reshape(2, -1)
    codes = planes[0].astype(int) + 256 * planes[1].astype(int)
    differences = np.where(codes % 2, -(codes + 1) // 2, codes // 2)
    shape = (1 + len(shown.motions), len(shown.joints), 3, len(shown.hidden))
    steps = differences.reshape(shape).cumsum(axis=-1)
    for joint, parent in enumerate(shown.parents):
        if parent >= 0:
            steps[:, joint] += steps[:, parent]
    steps[1:] += steps[0]
    return np.moveaxis(steps.astype(np.int16), -1, 1) * resolution(shown)


@given(truth=POSITIONS, made=POSITIONS)
def test_no_position_is_off_by_more_than_half_the_resolution(truth, made):
    shown = picture(truth, made)
    error = np.abs(decoded(encode(shown), shown) - [truth, made]).max()
    assert error <= resolution(shown) / 2 * (1 + 1e-9)


@given(POSITIONS)
def test_the_resolution_is_a_millimetre_unless_positions_are_far(positions):
    farthest = np.abs(positions).max()
    expected = FINEST if farthest <= 32767 * FINEST else farthest / 32767
    assert resolution(picture(positions, positions)) == pytest.approx(expected)


@pytest.fixture(scope="module")
def walk():
    """Return three seconds of a generated walk at 30 frames per second, and its skeleton."""
    motion = GaitLibrary().motion("01_01")
    frames = motion.recording("walk").frames(range(0, 360 if len(motion.values) > 360 else 331, 4))
    return joint_positions(motion.skeleton, frames), motion.skeleton


def test_a_motion_takes_at_most_eight_kilobytes(walk):
    truth, skeleton = walk
    shown = picture(truth, truth[::-1], parents=skeleton.parents)
    alone = picture(truth, truth, parents=skeleton.parents)
    assert len(encode(alone)) < 8_000
    assert len(encode(shown)) < 2 * 8_000


def test_what_is_as_recorded_takes_next_to_nothing(walk):
    truth, skeleton = walk
    one = len(encode(picture(truth, truth, parents=skeleton.parents)))
    eight = len(encode(picture(truth, *[truth] * 8, parents=skeleton.parents)))
    assert eight < 1.1 * one
