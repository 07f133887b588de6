"""The 59 values, by the laws that define them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.datasets import (
    GaitLibrary,
    taylor_deviations,
    taylor_features,
    taylor_scales,
    zero_based_frames,
)

ROOT = [
    *("root.dtx", "root.ty", "root.dtz"),
    *("root.rx.sin", "root.rx.cos", "root.rz.sin", "root.rz.cos"),
    *("root.ry.dsin", "root.ry.dcos"),
]


@pytest.fixture(scope="module")
def walk():
    return GaitLibrary().recording("01_01")


def unscaled(recording, channel):
    """Return one of the values in radians, or in the skeleton's unit of length."""
    return taylor_features(recording).select([channel]).values[:, 0] * taylor_deviations()[channel]


def kept(recording, channel):
    return recording.select([channel]).values[::4, 0]


def test_fifty_joint_angles_and_nine_values_of_the_root(walk):
    features = taylor_features(walk)
    angles = [name for name in features.channels if not name.startswith("root.")]
    assert len(angles) == 50
    assert [*features.channels] == angles + ROOT
    left_out = ("root", "rclavicle", "lclavicle", "rfingers", "lfingers")
    assert {*angles} == {n for n in walk.channels if n.partition(".")[0] not in left_out}
    assert [*taylor_scales()] == angles


def test_the_first_of_every_fourth_frame_serves_for_differences_only(walk):
    features = taylor_features(walk)
    np.testing.assert_array_equal(features.times, walk.times[4::4])
    assert features.visible.all()


def test_values_are_those_of_the_papers(walk):
    radians = {axis: np.deg2rad(kept(walk, f"root.{axis}")) for axis in ("rx", "ry", "rz")}
    expected = {
        "ltibia.rx": np.deg2rad(kept(walk, "ltibia.rx"))[1:],
        "root.dtx": np.diff(kept(walk, "root.tx")),
        "root.ty": kept(walk, "root.ty")[1:],
        "root.dtz": np.diff(kept(walk, "root.tz")),
        "root.rx.sin": np.sin(radians["rx"])[1:],
        "root.rz.cos": np.cos(radians["rz"])[1:],
        "root.ry.dsin": np.diff(np.sin(radians["ry"])),
        "root.ry.dcos": np.diff(np.cos(radians["ry"])),
    }
    assert np.abs(kept(walk, "ltibia.rx")).max() < 90.0
    for channel, values in expected.items():
        np.testing.assert_allclose(unscaled(walk, channel), values, atol=1e-12, err_msg=channel)


@settings(max_examples=20)
@given(turns=st.lists(st.integers(-3, 3), min_size=62, max_size=62))
def test_whole_turns_of_any_angle_change_nothing(walk, turns):
    angles = np.array([unit == "deg" for unit in walk.units])
    turned = walk.with_values(walk.values + 360.0 * np.where(angles, turns, 0))
    one, other = taylor_features(walk).values, taylor_features(turned).values
    np.testing.assert_allclose(one, other, atol=1e-8)


def test_the_place_on_the_floor_changes_nothing_and_height_does(walk):
    for channel, changes in {"root.tx": False, "root.tz": False, "root.ty": True}.items():
        moved = walk.with_values(walk.values + [5.0 * (name == channel) for name in walk.channels])
        one, other = taylor_features(walk).values, taylor_features(moved).values
        assert np.allclose(one, other, atol=1e-8) is not changes


def test_a_hidden_entry_hides_what_is_made_of_it(walk):
    hidden = np.zeros(walk.values.shape, dtype=bool)
    hidden[8, [walk.channels.index(name) for name in ("root.tx", "root.rx", "head.rx")]] = True
    features = taylor_features(walk.hide(hidden))
    lost = {(frame, features.channels[d]) for frame, d in np.argwhere(~features.visible)}
    assert lost == {
        *((1, "head.rx"), (1, "root.rx.sin"), (1, "root.rx.cos")),
        *((1, "root.dtx"), (2, "root.dtx")),
    }


def test_scales_are_reciprocal_deviations_in_degrees_where_no_joint_bends_beyond_a_right_angle():
    """Folding lowers the deviation of the others; Taylor's scales are of angles as they are."""
    products = {n: s * np.rad2deg(taylor_deviations()[n]) for n, s in taylor_scales().items()}
    folded = {name for name, product in products.items() if product < 0.8}
    sides = {f"{side}{channel}" for side in "lr" for channel in ("humerus.rz", "radius.rx")}
    assert folded == {"rhand.rz", *sides}
    others = [product for name, product in products.items() if name not in folded]
    np.testing.assert_allclose(others, 1.0, atol=0.11)


def test_a_recording_too_short_for_one_frame_is_refused(walk):
    assert len(taylor_features(zero_based_frames(walk, 0, 5)).times) == 1
    with pytest.raises(ValueError, match="expected five frames or more"):
        taylor_features(zero_based_frames(walk, 0, 4))


def test_a_recording_of_other_channels_is_refused(walk):
    with pytest.raises(ValueError, match=r"has no channels .*'lowerback.rx'"):
        taylor_features(walk.select(["head.rx", "root.tx"]))
