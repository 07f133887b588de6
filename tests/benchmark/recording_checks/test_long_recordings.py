"""Laws of what long recordings, and those with thousands of breaks, cost to check."""

import tracemalloc

import numpy as np
import pandas as pd
import pytest

from mocapbench.benchmark.recording_checks import leaps, paths, swaps
from mocapbench.benchmark.recording_checks.file_check import find_faults
from mocapbench.datasets import Recording


def swinging(n_frames, n_markers):
    """Return markers that swing, each with a gap in every second."""
    rng, times = np.random.default_rng(0), np.arange(n_frames) / 120
    shape = (n_frames, n_markers, 3)
    frequencies, phases = rng.uniform(0.5, 1.5, shape[1:]), rng.uniform(0, 6, shape[1:])
    values = 150 * np.sin(2 * np.pi * frequencies * times[:, None, None] + phases)
    values += rng.uniform(200, 1800, shape[1:]) + rng.normal(0, 0.1, shape)
    for marker in range(n_markers):
        for start in range(60, n_frames - 60, 120):
            first = start + int(rng.integers(40))
            values[first : first + 15, marker] = np.nan
    names = [f"M{marker}.{axis}" for marker in range(n_markers) for axis in "xyz"]
    return Recording("long", times, values.reshape(n_frames, -1), names, ["mm"] * len(names))


@pytest.mark.parametrize("n_steps", [1, 4, 9, 300])
def test_the_excess_of_a_step_is_that_over_the_median_of_the_steps_around_it(n_steps):
    rng = np.random.default_rng(0)
    shape = (n_steps + 1, 5, 3)
    positions = rng.normal(size=shape)
    positions[rng.random(shape[:2]) < 0.3] = np.nan
    steps = np.diff(positions, axis=0)
    columns = pd.DataFrame(steps.reshape(n_steps, 15))
    median = columns.rolling(9, min_periods=1, center=True).median().to_numpy()
    names, none = tuple("ABCDE"), np.zeros(n_steps, dtype=bool)
    found = paths.MotionPaths(names, positions, np.full(5, -1.0), 120.0, none)
    for marker in range(5):  # one by one, as all together
        np.testing.assert_array_equal(
            found.measure_excess(marker), steps[:, marker] - median.reshape(steps.shape)[:, marker]
        )


@pytest.mark.parametrize("least", [0.3, 1.0, 2.0])
def test_leaps_are_those_that_all_steps_show_though_few_are_measured(least):
    rng, n_steps = np.random.default_rng(0), 3000
    positions = rng.normal(0, 0.1, (n_steps + 1, 4, 3)).cumsum(axis=0)
    for marker in range(4):
        positions[rng.integers(0, n_steps, 10), marker] += rng.normal(0, 1.5, (10, 3))
    positions[rng.random(positions.shape[:2]) < 0.02] = np.nan
    missing, names = rng.random(n_steps) < 0.001, tuple("ABCD")
    few, all_steps = (
        paths.MotionPaths(names, positions, np.full(4, one), 20.0, missing) for one in (least, -1.0)
    )
    sizes, usual = all_steps.sizes, all_steps.usual_sizes
    with np.errstate(invalid="ignore"):
        expected = sizes > np.maximum(3.0 * usual, least)
    np.testing.assert_array_equal(leaps.find_leaps(few, 3.0), expected)
    assert expected.any()
    assert np.isfinite(few.sizes).sum() < np.isfinite(sizes).sum() or least < 1.0
    np.testing.assert_array_equal(few.sizes[expected], sizes[expected])


def test_the_extent_is_the_same_whichever_frames_are_looked_at_together(monkeypatch):
    positions = swinging(1000, 6).values.reshape(1000, 6, 3)
    whole = paths.measure_extent(positions)
    monkeypatch.setattr(paths, "_BLOCK", 7)
    assert paths.measure_extent(positions) == whole


@pytest.mark.parametrize("together", [1, 3, 1000])
def test_each_pair_of_breaks_that_overlap_is_compared_once(together, monkeypatch):
    monkeypatch.setattr(swaps, "_TOGETHER", together)
    rng = np.random.default_rng(0)
    last = np.sort(rng.integers(0, 60, 40))
    marker, first = rng.integers(0, 4, 40), last + rng.integers(1, 9, 40)
    groups = [*swaps._pair_breaks(marker, last, first)]
    found = [pair for one, other in groups for pair in zip(one, other, strict=True)]
    assert sorted(found) == [
        (k, other)
        for k in range(40)
        for other in range(k + 1, 40)
        if last[other] < first[k] and marker[other] != marker[k]
    ]


def test_breaks_are_compared_many_at_a_time(monkeypatch):
    calls = []
    given = swaps._compare_misses
    monkeypatch.setattr(
        swaps, "_compare_misses", lambda *args: calls.append(len(args[2])) or given(*args)
    )
    find_faults(swinging(6000, 8))
    assert sum(calls) > 100 * len(calls)


def test_steps_far_below_a_leap_are_not_compared_with_those_around_them():
    given = swinging(600, 4)
    still = paths.find_marker_paths(given)
    assert np.isnan(still.usual_sizes).all()
    values = given.values.copy()
    values[300, :3] += 400.0
    leaping = paths.find_marker_paths(given.with_values(values))
    assert np.isfinite(leaping.usual_sizes).any(axis=0).tolist() == [True, False, False, False]


def test_the_memory_of_a_check_is_a_few_times_that_of_the_recording():
    recording = swinging(40_000, 10)
    find_faults(recording.frames(np.arange(500)))  # what is loaded at first use
    tracemalloc.start()
    find_faults(recording)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 3.5 * recording.values.nbytes
