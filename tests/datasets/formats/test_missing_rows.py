"""Missing rows: told by times that stand out, however evenly a camera took its frames."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.benchmark.recording_checks.file_check import find_all
from mocapbench.datasets import Recording
from mocapbench.datasets.formats.missing_rows import count_missing_rows

N_STEPS = 240


def jitter(rng, spread):
    """Return steps of times of a camera that is early or late by some share of a step."""
    return (1.0 + spread * rng.normal(size=N_STEPS)).clip(0.3)


def lose_rows(rng, steps, fewest):
    """Return steps of times, of which five have some rows fewer, and how many each has."""
    lost = np.zeros(N_STEPS, dtype=int)
    lost[rng.choice(N_STEPS, 5, replace=False)] = rng.integers(fewest, 9, 5)
    return np.concatenate([[0.0], np.cumsum(steps + lost)]) / 30.0, lost


@settings(max_examples=50)
@given(st.integers(0, 10**6), st.sampled_from([(0.0, 1), (0.1, 2), (0.25, 4)]))
def test_rows_are_missing_where_steps_are_far_longer_than_times_spread(seed, kind):
    rng, (spread, fewest) = np.random.default_rng(seed), kind
    times, lost = lose_rows(rng, jitter(rng, spread), fewest)
    counts = count_missing_rows(len(times), None, times)
    np.testing.assert_array_equal(counts > 0, lost > 0)
    assert np.abs(counts - lost).max() <= 1 + 8 * spread


@pytest.mark.parametrize(
    ("rate", "digits"), [(24, 2), (25, 2), (30, 2), (50, 2), (60, 2), (100, 2), (240, 3), (120, 3)]
)
def test_times_that_were_rounded_lack_no_row(rate, digits):
    times = np.round(np.arange(500) / rate, digits)
    assert not count_missing_rows(500, None, times).any()


@pytest.mark.parametrize(("step", "n_rows"), [(1.65, 0), (1.75, 1), (2.6, 2)])
def test_a_step_is_one_row_more_from_seven_tenths_on(step, n_rows):
    """Of times of real files no step was between 1.06 and 2 usual ones."""
    steps = np.ones(20)
    steps[7] = step
    counts = count_missing_rows(21, None, np.concatenate([[0.0], np.cumsum(steps)]))
    assert (counts[7], counts.sum()) == (n_rows, n_rows)


@pytest.mark.parametrize("spread", [0.0, 0.2])
def test_a_step_over_missing_rows_is_a_finding_and_no_leap(spread):
    rng = np.random.default_rng(1)
    times, lost = lose_rows(rng, jitter(rng, spread), 4)
    starts = np.array([[0.0, 0, 0], [0, 900, 0], [300, 0, 500]])
    positions = starts + times[:, None, None] * [1200.0, 100.0, 0.0]
    positions += 80 * np.sin(6 * times)[:, None, None] + rng.normal(0, 0.3, positions.shape)
    channels = [f"{name}.{axis}" for name in "ABC" for axis in "xyz"]
    found = find_all(Recording("walk", times, positions.reshape(-1, 9), channels, ["mm"] * 9))
    assert {*found["kind"]} == {"rows"}
    assert found["start"].tolist() == np.flatnonzero(lost).tolist()
    assert found["size"].tolist() == count_missing_rows(len(times), None, times)[lost > 0].tolist()
