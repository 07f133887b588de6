from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.functional.cycle_period import (
    complete_blocks,
    cycle_periods,
    signal_to_noise,
)
from mocapbench.datasets import Recording


@settings(max_examples=25, deadline=None)
@given(
    period=st.floats(10.0, 50.0),
    noise=st.sampled_from([0.01, 0.1, 0.3]),
    hidden=st.sampled_from([0.0, 0.3, 0.6]),
    seed=st.integers(0, 1000),
)
def test_the_length_of_a_cycle_is_recovered(waves, period, noise, hidden, seed):
    recordings = waves([period], noise=noise, hidden=hidden, seed=seed).recordings
    assert 30.0 * cycle_periods(recordings)[0] == pytest.approx(period, rel=0.05)


def test_less_than_two_cycles_are_enough(waves):
    assert 30.0 * cycle_periods(waves([22.0], n_frames=36, noise=0.05).recordings)[
        0
    ] == pytest.approx(22.0, rel=0.05)


def test_units_of_time_and_a_late_start_mean_nothing(waves):
    (wave,) = waves([20.0]).recordings
    later = replace(wave, times=5.0 + 10.0 * wave.times)
    one, ten = cycle_periods([wave])[0], cycle_periods([later])[0]
    assert ten == pytest.approx(10.0 * one, rel=1e-3)


def test_a_recording_without_a_cycle_takes_the_median_of_the_others(waves):
    values = np.arange(80.0).reshape(40, 2)
    drift = Recording("drift", np.arange(40) / 30, values, ("a", "b"), ("", ""))
    short = waves([20.0]).recordings[0].frames([0, 1, 2])
    *cyclic, one, two = cycle_periods([*waves([20.0, 24.0, 28.0]).recordings, drift, short])
    assert one == two == np.median(cyclic)


def test_where_nothing_repeats_each_recording_is_one_cycle(waves):
    (wave,) = waves([20.0]).recordings
    single, three = wave.frames([4]), wave.frames([0, 1, 2])
    np.testing.assert_allclose(cycle_periods([single, three]), [1.0, 0.1])


def test_the_ratio_is_that_of_a_regression_on_the_folded_recording(waves):
    (wave,) = waves([20.0], hidden=0.2).recordings
    frequency = 1.4
    signal = squares = freedom = 0.0
    for values in wave.values.T:
        seen = ~np.isnan(values)
        angles = 2.0 * np.pi * frequency * wave.times[seen, None] * np.arange(1, 4)
        basis = np.hstack([np.ones((seen.sum(), 1)), np.cos(angles), np.sin(angles)])
        penalty = 1e-3 * np.diag([1e-6, 1, 16, 81, 1, 16, 81])
        hat = basis @ np.linalg.inv(basis.T @ basis + penalty) @ basis.T
        fit = hat @ values[seen]
        signal += ((fit - fit.mean()) ** 2).sum()
        squares += ((values[seen] - fit) ** 2).sum()
        freedom += np.trace(hat)
    total = wave.visible.sum()
    expected = signal / squares * (1.0 - freedom / total) ** 2
    found = signal_to_noise(complete_blocks(wave), np.array([frequency]))
    assert found == pytest.approx(expected, rel=1e-6)
