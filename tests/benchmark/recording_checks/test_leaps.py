"""Spikes, jumps, swaps and odd segments that were planted are found, and nothing else."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.benchmark.recording_checks.file_check import find_all
from mocapbench.datasets import Recording

N_FRAMES, N_MARKERS, RATE = 240, 8, 120.0
NAMES = [f"M{k}" for k in range(N_MARKERS)]
MARKERS = st.integers(0, N_MARKERS - 1)
FRAMES = st.integers(20, N_FRAMES - 40)


def move(rng, unit=1.0):
    """Return positions (N, M, 3) of markers of a body that walks, turns and swings, with noise."""
    times = np.arange(N_FRAMES)[:, None, None] / RATE
    places = np.array([[x, 150.0 * k, 200.0 * k] for k in range(4) for x in (0.0, 300.0)])
    swing = 80 * np.sin(6 * times + np.arange(N_MARKERS)[:, None] // 4 + np.arange(3))
    noise = rng.normal(0, 0.3, (N_FRAMES, N_MARKERS, 3))
    return unit * (places + swing + np.array([1200.0, 0.0, 0.0]) * times + noise)


def record(positions, unit="mm"):
    channels = [f"{name}.{axis}" for name in NAMES for axis in "xyz"]
    times = np.arange(len(positions)) / RATE
    return Recording("walk", times, positions.reshape(-1, 24), channels, [unit] * 24)


def list_faults(positions, unit="mm"):
    found = find_all(record(positions, unit))
    found = found[found["kind"].isin(["spike", "jump", "swap", "segment"])]
    return [*found[["kind", "markers", "start", "stop"]].itertuples(index=False, name=None)]


@settings(max_examples=20)
@given(st.integers(0, 10**6), st.sampled_from([("mm", 1.0), ("m", 1e-3), ("", 0.1)]))
def test_a_body_that_moves_has_no_fault(seed, unit):
    assert list_faults(move(np.random.default_rng(seed), unit[1]), unit[0]) == []


@settings(max_examples=20)
@given(
    st.integers(0, 10**6),
    st.tuples(MARKERS, FRAMES),
    st.integers(1, 3),
    st.sampled_from([20.0, 50.0, 200.0]),
    st.sampled_from([("mm", 1.0), ("m", 1e-3), ("", 0.1)]),
)
def test_a_spike_is_found_in_its_frames_in_any_unit(seed, where, length, size, unit):
    marker, frame = where
    rng = np.random.default_rng(seed)
    positions = move(rng)
    way = rng.normal(size=3)
    positions[frame : frame + length, marker] += size * way / np.linalg.norm(way)
    expected = [("spike", (NAMES[marker],), frame, frame + length)]
    assert list_faults(unit[1] * positions, unit[0]) == expected


@settings(max_examples=20)
@given(st.integers(0, 10**6), MARKERS, FRAMES, st.integers(1, 3), st.booleans())
def test_a_spike_is_found_beside_a_gap(seed, marker, frame, length, before):
    positions = move(np.random.default_rng(seed))
    gap = slice(frame + length, frame + 20) if before else slice(frame - 12, frame)
    positions[frame : frame + length, marker] += 60.0
    positions[gap, marker] = np.nan
    assert list_faults(positions) == [("spike", (NAMES[marker],), frame, frame + length)]


@settings(max_examples=20)
@given(st.integers(0, 10**6), FRAMES)
def test_a_marker_that_does_not_come_back_jumps(seed, frame):
    positions = move(np.random.default_rng(seed))
    positions[frame:, 3] += 60.0
    assert ("jump", ("M3",), frame - 1, frame + 1) in list_faults(positions)


def test_two_jumps_in_a_row_that_lead_away_are_no_spike():
    positions = move(np.random.default_rng(0))
    positions[100:, 3, 0] += 60.0
    positions[102:, 3, 1] += 60.0
    found = [kind for kind, *_ in list_faults(positions) if kind != "segment"]
    assert found == ["jump", "jump"]


def test_a_blow_of_several_frames_is_no_jump():
    positions = move(np.random.default_rng(0))
    positions[100:, 3] += np.minimum(np.arange(140), 4)[:, None] * np.array([30.0, 0.0, 0.0])
    assert "jump" not in [kind for kind, *_ in list_faults(positions)]


@settings(max_examples=20)
@given(st.integers(0, 10**6), st.permutations(range(N_MARKERS)), FRAMES, st.integers(0, 18))
def test_two_markers_that_trade_places_are_found_beside_a_gap_or_not(seed, order, frame, gap):
    positions = move(np.random.default_rng(seed))
    pair = sorted(order[:2])
    positions[frame:, pair] = positions[frame:, pair[::-1]]
    positions[frame : frame + gap, pair] = np.nan
    names = tuple(NAMES[marker] for marker in pair)
    assert list_faults(positions) == [("swap", names, frame + gap, N_FRAMES)]


@settings(max_examples=20)
@given(st.integers(0, 10**6), FRAMES, st.integers(1, 30))
def test_a_swap_ends_where_places_are_traded_back(seed, frame, length):
    positions = move(np.random.default_rng(seed))
    rows = slice(frame, frame + length)
    positions[rows, [[2], [5]]] = positions[rows, [[5], [2]]]
    assert list_faults(positions) == [("swap", ("M2", "M5"), frame, frame + length)]


def test_no_swap_is_seen_in_gaps_of_markers_that_stay_who_they_are():
    positions = move(np.random.default_rng(0))
    positions[100:130] = np.nan
    assert list_faults(positions) == []


def test_a_marker_that_returns_elsewhere_after_a_gap_changes_a_segment():
    positions = move(np.random.default_rng(0))
    positions[100:115, 3] = np.nan
    positions[115:125, 3] += 90.0
    positions[125:140, 3] = np.nan
    kinds = {(kind, start, stop) for kind, names, start, stop in list_faults(positions)}
    assert kinds == {("segment", 115, 125)}


def test_gaps_ends_and_frames_without_any_marker_are_told_apart():
    positions = move(np.random.default_rng(0))
    positions[:5, 0] = positions[100:110, 0] = positions[235:, 0] = np.nan
    positions[105:107] = np.nan
    positions[:, 7, 1] = np.nan
    found = find_all(record(positions))
    told = {
        (r.kind, r.markers, r.start, r.stop) for r in found.itertuples() if r.markers != ("M1",)
    }
    assert {
        ("before", ("M0",), 0, 5),
        ("gap", ("M0",), 100, 110),
        ("after", ("M0",), 235, N_FRAMES),
        ("gap", ("M2",), 105, 107),
        ("never", ("M7",), 0, N_FRAMES),
        ("empty", (), 105, 107),
    } <= told


@pytest.mark.parametrize("n_frames", [0, 1, 2, 5])
def test_few_frames_have_no_fault(n_frames):
    assert list_faults(move(np.random.default_rng(0))[:n_frames]) == []
