import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.kriging.mirror_images import find_symmetries
from mocapbench.datasets import Recording, gpdm_features, open_archive

CHANNELS = ("root.dtx", "root.ry", "lfemur.rx", "lfemur.rz", "rfemur.rx", "rfemur.rz")


def walk(channels=CHANNELS, lag=20, n_frames=60):
    """Return a walk of 40 frames a cycle; the right leg follows the left one by ``lag`` frames."""
    left = 2 * np.pi * np.arange(n_frames) / 40
    right = left - 2 * np.pi * lag / 40
    sway, turn = np.sin(left), np.cos(left)
    legs = [np.sin(left), np.cos(left), np.sin(right), -np.cos(right)]
    values = np.column_stack([sway, turn, *legs])
    times = np.arange(n_frames) / 30
    return Recording("walk", times, values, channels, ("deg",) * len(channels))


def test_the_mirror_image_of_a_walk_is_the_walk_half_a_cycle_later():
    itself, mirrored = find_symmetries([walk()])
    values = walk().values
    np.testing.assert_array_equal(itself.of(values), values)
    np.testing.assert_allclose(mirrored.of(values)[20:], values[:-20], atol=1e-12)


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 1000))
def test_a_mirror_image_of_a_mirror_image_is_the_motion_itself(seed):
    _, mirrored = find_symmetries([walk()])
    frames = np.random.default_rng(seed).normal(size=(7, len(CHANNELS)))
    np.testing.assert_array_equal(mirrored.of(mirrored.of(frames)), frames)


def test_a_motion_unlike_its_mirror_image_has_none():
    assert len(find_symmetries([walk(lag=0)])) == 1
    assert len(find_symmetries([walk().with_values(np.zeros((60, 6)))])) == 1


@pytest.mark.parametrize(
    "channels",
    [
        ("a", "b", "c", "d", "e", "f"),
        ("root.dtx", "root.ry", "lfemur.rx", "lfemur.rz", "rfemur.rx", "rfemur.w"),
        ("root.dtx", "root.ry", "lfemur.rx", "lfemur.rz", "rtibia.rx", "rtibia.rz"),
        ("root.dtx", "root.ry", "lfemur.rx", "lfemur.rz", "rfemur.rx", "rfemur.ry"),
    ],
)
def test_names_that_do_not_tell_left_from_right_have_no_mirror_image(channels):
    assert len(find_symmetries([walk(channels)])) == 1


def test_generated_walkers_are_symmetric():
    recording = gpdm_features(open_archive().recording("gait:01_01"))
    _, mirrored = find_symmetries([recording])
    names = np.array(recording.channels)
    assert names[mirrored.order][names == "lfemur.rx"] == "rfemur.rx"
    assert names[mirrored.order][names == "lowerback.ry"] == "lowerback.ry"
    assert mirrored.signs[names == "lowerback.ry"] == -1
