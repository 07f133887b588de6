"""Swaps of near markers across gaps, which only the distances from others tell."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.benchmark.recording_checks.paths import find_marker_paths
from mocapbench.benchmark.recording_checks.swaps import find_swaps
from mocapbench.datasets import Recording

RATE, N_FRAMES = 100.0, 600


def turn(rng, n_markers=7):
    """Return markers (N, M, 3) of a rigid body that turns back and forth, two of them near."""
    places = rng.uniform(-300, 300, (n_markers, 3))
    places[1] = places[0] + [0, 50, 0]
    times = np.arange(N_FRAMES) / RATE
    angles = 1.5 * np.sin(4 * times + rng.uniform(0, 6))
    cos, sin, zero, one = np.cos(angles), np.sin(angles), 0 * times, 1 + 0 * times
    turns = np.array([[cos, -sin, zero], [sin, cos, zero], [zero, zero, one]])
    noise = rng.normal(0, 0.5, (N_FRAMES, n_markers, 3))
    return np.einsum("ijn,mj->nmi", turns, places) + noise


def list_swaps(positions):
    n_markers = positions.shape[1]
    channels = [f"M{k}.{axis}" for k in range(n_markers) for axis in "xyz"]
    times = np.arange(len(positions)) / RATE
    values = positions.reshape(len(times), -1)
    recording = Recording("", times, values, channels, ["mm"] * len(channels))
    found = find_swaps(find_marker_paths(recording))
    return [*found[["markers", "start", "stop"]].itertuples(index=False, name=None)]


@settings(max_examples=25)
@given(st.integers(0, 10**6), st.integers(50, 450), st.integers(5, 100), st.booleans())
def test_near_markers_are_told_apart_across_gaps_in_which_they_turn(seed, frame, gap, swapped):
    positions = turn(np.random.default_rng(seed))
    if swapped:
        positions[frame:, [0, 1]] = positions[frame:, [1, 0]]
    positions[frame : frame + gap, [0, 1]] = np.nan
    expected = [(("M0", "M1"), frame + gap, N_FRAMES)] if swapped else []
    assert list_swaps(positions) == expected


@settings(max_examples=15)
@given(st.integers(0, 10**6), st.integers(50, 450), st.integers(5, 60), st.integers(1, 40))
def test_gaps_of_which_one_begins_as_the_other_ends_may_hide_a_swap(seed, frame, first, second):
    """A program takes a marker that comes back for the other one, which it then loses."""
    positions = turn(np.random.default_rng(seed))
    positions[frame : frame + first, 0] = np.nan
    positions[frame + first :, [0, 1]] = positions[frame + first :, [1, 0]]
    positions[frame + first : frame + first + second, 1] = np.nan
    assert list_swaps(positions) == [(("M0", "M1"), frame + first + second, N_FRAMES)]


def test_all_markers_hidden_at_once_are_told_apart():
    positions = turn(np.random.default_rng(0))
    positions[300:320] = np.nan
    assert list_swaps(positions) == []
    positions[320:, [2, 4]] = positions[320:, [4, 2]]
    assert list_swaps(positions) == [(("M2", "M4"), 320, N_FRAMES)]


@pytest.mark.parametrize("n_markers", [2, 3])
def test_few_markers_are_told_apart_by_where_they_go(n_markers):
    times = np.arange(N_FRAMES)[:, None, None] / RATE
    ways = np.array([[500.0, 0, 0], [500.0, 50, 0], [500.0, 0, 80]])[:n_markers]
    positions = times * ways + np.array([[0.0, 0, 0], [0, 100, 0], [0, 0, 300]])[:n_markers]
    positions += np.random.default_rng(0).normal(0, 0.3, positions.shape)
    positions[300:310, [0, 1]] = np.nan
    assert list_swaps(positions) == []
    positions[310:, [0, 1]] = positions[310:, [1, 0]]
    assert list_swaps(positions) == [(("M0", "M1"), 310, N_FRAMES)]


def test_no_swap_is_sought_across_gaps_of_more_than_two_seconds():
    positions = turn(np.random.default_rng(0))
    positions[200:, [0, 1]] = positions[200:, [1, 0]]
    positions[200:401, [0, 1]] = np.nan
    assert list_swaps(positions) == []
