"""Recordings that do not belong together are told apart, and what differs is named."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.datasets import FormatError, Recording, check_alike, frame_rate

ONE = Recording("one.csv", np.arange(10) / 120, np.zeros((10, 2)), ["hip", "knee"], ["cm", "deg"])


@given(st.floats(20.0, 400.0), st.integers(12, 60), st.data())
def test_the_rate_is_that_of_times_rounded_to_milliseconds_with_frames_missing(rate, n, data):
    kept = data.draw(st.lists(st.integers(1, n - 2), max_size=3, unique=True))
    times = np.delete(np.round(np.arange(n) / rate, 5), kept)
    recording = Recording("walk", times, np.zeros((len(times), 1)), ["hip"], [""])
    assert frame_rate(recording) == pytest.approx(rate, rel=0.01)


def test_a_single_frame_has_no_rate_and_goes_with_any():
    single = ONE.frames([3])
    assert np.isnan(frame_rate(single))
    check_alike([ONE, single])
    check_alike([single, ONE])


def test_small_differences_of_the_rate_are_those_of_writing_it():
    check_alike([ONE, replace(ONE, times=np.arange(10) * 0.00833)])


@pytest.mark.parametrize(
    ("other", "complaint"),
    [
        (
            replace(ONE, channels=("hip", "toe")),
            "the 2 channels of one.csv, got no knee, besides toe",
        ),
        (replace(ONE, channels=("knee", "hip")), "got another order; use files of one marker set"),
        (replace(ONE, units=("mm", "deg")), "hip in cm, as in one.csv, got mm; convert"),
        (replace(ONE, units=("", "deg")), "hip in cm, as in one.csv, got no unit"),
        (replace(ONE, times=np.arange(10) / 100), "120 frames per second, .*, got 100; resample"),
    ],
)
def test_what_differs_is_named(other, complaint):
    with pytest.raises(FormatError, match=f"two.csv: expected .*{complaint}"):
        check_alike([ONE, ONE, replace(other, name="two.csv")])
