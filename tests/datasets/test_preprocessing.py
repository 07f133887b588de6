"""Choosing frames, and the root's path as differences."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.datasets import (
    Recording,
    integrate_root,
    one_based_frames,
    resample,
    restart,
    root_differences,
    zero_based_frames,
)

CHANNELS = ("root.tx", "root.ty", "root.tz", "knee.rx")


def recorded(values):
    times = np.arange(len(values)) / 120
    return Recording("walk", times, values, CHANNELS, ("", "", "", "deg"))


WALK = recorded(np.arange(40.0).reshape(10, 4) ** 2)


def test_zero_based_frames_are_half_open_and_cut_at_the_end():
    np.testing.assert_array_equal(zero_based_frames(WALK, 2, 5).values, WALK.values[2:5])
    np.testing.assert_array_equal(zero_based_frames(WALK, 7, 500).values, WALK.values[7:])
    np.testing.assert_array_equal(zero_based_frames(WALK, 2, 5).times, WALK.times[2:5])


@pytest.mark.parametrize("window", [(10, 12), (-1, 3), (5, 5), (5, 3)])
def test_zero_based_frames_refuse_a_window_without_frames(window):
    with pytest.raises(ValueError, match="10 frames"):
        zero_based_frames(WALK, *window)


def test_one_based_frames_include_the_last():
    np.testing.assert_array_equal(one_based_frames(WALK, 1, 10).values, WALK.values)
    np.testing.assert_array_equal(one_based_frames(WALK, 3, 4).values, WALK.values[2:4])


@pytest.mark.parametrize("frames", [(0, 4), (4, 3), (4, 11)])
def test_one_based_frames_must_all_exist(frames):
    with pytest.raises(ValueError, match="1 to 10"):
        one_based_frames(WALK, *frames)


@given(st.integers(1, 10))
def test_resampling_keeps_first_and_chooses_evenly(n_frames):
    chosen = resample(WALK, n_frames)
    expected = np.round(np.linspace(0, 9, n_frames)).astype(int)
    np.testing.assert_array_equal(chosen.values, WALK.values[expected])


@pytest.mark.parametrize("n_frames", [0, 11])
def test_resampling_never_repeats_a_frame(n_frames):
    with pytest.raises(ValueError, match="1 to 10"):
        resample(WALK, n_frames)


def test_a_difference_is_next_minus_current_and_the_last_is_copied():
    walk = recorded([[0, 5, 1, 7], [1, 5, 3, 8], [4, 4, 6, 9]])
    moved = root_differences(walk)
    assert moved.channels == ("root.dtx", "root.dty", "root.dtz", "knee.rx")
    assert moved.units == walk.units
    np.testing.assert_array_equal(moved.values, [[1, 0, 2, 7], [3, -1, 3, 8], [3, -1, 3, 9]])


@given(arrays(np.float64, st.tuples(st.integers(2, 8), st.just(4)), elements=st.floats(-1e3, 1e3)))
def test_integration_undoes_differences_but_for_the_start(values):
    back = integrate_root(root_differences(recorded(values)))
    assert back.channels == CHANNELS
    np.testing.assert_allclose(back.values[:, :3], values[:, :3] - values[0, :3], atol=1e-9)
    np.testing.assert_array_equal(back.values[:, 3], values[:, 3])


def test_a_path_is_needed():
    with pytest.raises(ValueError, match="two frames"):
        root_differences(WALK.frames([0]))
    for function in (root_differences, integrate_root):
        with pytest.raises(ValueError, match="has no channels"):
            function(WALK.select(["knee.rx"]))


def test_windows_of_one_length_have_equal_times_bit_for_bit_wherever_they_begin():
    times = np.arange(500) / 120
    recording = Recording("r", times, np.zeros((500, 1)), ("x",), ("",))
    early, late = (restart(zero_based_frames(recording, start, start + 300)) for start in (0, 130))
    assert early.times[0] == 0.0
    np.testing.assert_array_equal(early.times, late.times)
    np.testing.assert_allclose(late.times, times[:300], atol=1e-9)
