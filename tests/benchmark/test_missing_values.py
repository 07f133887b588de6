"""Missing values that a file writes as numbers: which are told, and which are real."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shared_files import shared_like

from mocapbench.benchmark import format_for
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.missing_values import (
    choose_missing_rule,
    tell_missing,
    undecided_values,
)
from mocapbench.datasets import GaitLibrary, Recording, joint_positions

N_FRAMES, N_MARKERS = 200, 6


def walking(seed=0, speed=10.0, offset=900.0, digits=3):
    """Return markers that move together, with some noise, written with so many digits."""
    rng = np.random.default_rng(seed)
    times = np.arange(N_FRAMES) / 100
    path = np.column_stack([1000 * times, 50 * np.sin(6 * times), 30 * np.cos(11 * times)])
    places = rng.uniform(-300, 300, (N_MARKERS, 3)) + offset
    swing = speed * np.sin(5 * times[:, None, None] + rng.uniform(0, 6, (N_MARKERS, 3)))
    values = path[:, None] + places + swing + rng.normal(0, 0.2, (N_FRAMES, N_MARKERS, 3))
    channels = [f"M{k}.{axis}" for k in range(N_MARKERS) for axis in "xyz"]
    rounded = np.round(values, digits).reshape(N_FRAMES, -1)
    return Recording("walk", times, rounded, channels, ["mm"] * len(channels))


def marked(recording, rows, channels, value):
    values = recording.values.copy()
    values[rows, channels] = value
    return recording.with_values(values)


def held(recording, start, stop, channels):
    values = recording.values.copy()
    values[start:stop, channels] = values[start - 1, channels]
    return recording.with_values(values)


FIRST = slice(0, 3)
GAPS = [(50, 60), (0, 30), (180, 200), (2, 199)]


@given(st.sampled_from(GAPS), st.integers(0, 4), st.sampled_from([0.0, 9999.0, -9999999.0, 1e30]))
def test_zeros_and_numbers_that_nothing_measures_are_told(gap, marker, value):
    rows, channels = slice(*gap), slice(3 * marker, 3 * marker + 3)
    given_ = marked(walking(), rows, channels, value)
    mask, remarks = tell_missing(given_)
    expected = np.zeros(mask.shape, dtype=bool)
    expected[rows, channels] = True
    assert np.array_equal(mask, expected)
    assert len(remarks) == 1


def test_zeros_of_points_in_a_video_are_told():
    walk = walking()
    flat = walk.select([name for name in walk.channels if not name.endswith("z")])
    mask, remarks = tell_missing(marked(flat, slice(50, 60), slice(0, 2), 0.0))
    expected = np.zeros(mask.shape, dtype=bool)
    expected[50:60, :2] = True
    assert np.array_equal(mask, expected)
    assert "is exactly 0, 0 in 10 frames, far from where it is" in remarks[0]


def test_zeros_between_which_no_step_is_seen_are_not_told():
    alternating = marked(walking(), slice(0, None, 2), FIRST, 0.0)
    assert not tell_missing(alternating)[0].any()
    assert "M0 is exactly 0, 0, 0 in 100 frames" in undecided_values(alternating)


def test_zeros_of_a_marker_that_is_never_seen_count_where_those_of_another_are_told():
    lost = marked(walking(), slice(None), slice(3, 6), 0.0)
    assert not tell_missing(lost)[0].any()
    mask, _ = tell_missing(marked(lost, slice(50, 60), FIRST, 0.0))
    assert mask[:, 3:6].all()
    assert mask.sum() == 3 * N_FRAMES + 30


def test_a_marker_that_passes_the_origin_is_there():
    through = walking()
    values = through.values.copy()
    values[:, :3] -= values[80, :3]
    assert not tell_missing(through.with_values(values))[0].any()
    assert "M0 is exactly 0, 0, 0 in 1 frame" in undecided_values(through.with_values(values))


@pytest.mark.parametrize("value", [999.0, 9999.0, 12345.0])
def test_a_number_within_reach_of_the_others_is_a_measurement(value):
    recording = walking(offset=value - 1000)
    near = marked(recording, slice(50, 52), 0, value)
    assert not tell_missing(near)[0].any()


def test_a_constant_channel_is_a_measurement_however_large():
    recording = walking()
    rate = replace(
        recording,
        values=np.column_stack([recording.values / 1e4, np.full(N_FRAMES, 1000.0)]),
        channels=(*recording.channels, "rate"),
        units=(*recording.units, ""),
    )
    assert not tell_missing(rate)[0].any()


@given(st.integers(0, 4), st.integers(2, 150), st.integers(5, 40))
def test_a_position_that_is_held_and_leaps_on_is_told(marker, start, length):
    channels = slice(3 * marker, 3 * marker + 3)
    mask, remarks = tell_missing(held(walking(), start, start + length, channels))
    expected = np.zeros(mask.shape, dtype=bool)
    expected[start : start + length, channels] = True
    assert np.array_equal(mask, expected)
    assert f"M{marker} keeps the position of the frame before for {length} frames" in remarks[0]


@pytest.mark.parametrize(("start", "stop"), [(150, N_FRAMES), (1, 40)])
def test_a_position_that_is_held_at_an_end_is_told(start, stop):
    recording = walking()
    for first in range(0, 3 * N_MARKERS, 3):
        channels = slice(first, first + 3)
        mask, _ = tell_missing(held(recording, start, stop, channels))
        assert mask[start:stop, channels].all()
        assert mask.sum() == 3 * (stop - start)


def test_a_foot_that_stands_exactly_still_is_there():
    """It comes to rest and leaves slowly, as a foot that a program locks to the floor."""
    recording = walking()
    values = recording.values.copy()
    standing = np.r_[np.linspace(-1, 0, 60) ** 3, np.zeros(60), np.linspace(0, 1, 80) ** 3]
    values[:, :3] = 900 + 400 * standing[:, None] * [1.0, 0.3, 0.5]
    stands = recording.with_values(values)
    for part in (stands, stands.frames(np.arange(120)), stands.frames(np.arange(60, N_FRAMES))):
        assert not tell_missing(part)[0].any()


def test_whoever_stands_still_is_there():
    still = walking()
    values = still.values.copy()
    values[60:120] = values[60]
    assert not tell_missing(still.with_values(values))[0].any()


def test_what_a_single_marker_holds_is_left_and_said():
    alone = held(walking(), 50, 70, FIRST).select(["M0.x", "M0.y", "M0.z"])
    mask, remarks = tell_missing(alone)
    assert not mask.any()
    assert remarks[0].startswith("M0 is exactly where the frame before has it for 20 frames: if")


def test_markers_in_a_plane_are_held_as_others_are():
    flat = marked(held(walking(), 50, 70, FIRST), slice(None), slice(2, None, 3), 0.0)
    expected = np.zeros(flat.values.shape, dtype=bool)
    expected[50:70, FIRST] = True
    assert np.array_equal(tell_missing(flat)[0], expected)


def test_positions_of_few_digits_may_repeat():
    assert not tell_missing(walking(speed=0.0, digits=0))[0].any()


SKELETON = GaitLibrary()


@pytest.mark.parametrize("digits", [1, 3, 9])
def test_nothing_is_told_of_a_walk_that_lacks_nothing(digits):
    walk = SKELETON.recording("01_05")
    positions = 10 * joint_positions(SKELETON.skeleton("01_05"), walk).reshape(len(walk.times), -1)
    channels = [f"J{k // 3}.{'xyz'[k % 3]}" for k in range(positions.shape[1])]
    markers = Recording(
        "walk", walk.times, np.round(positions, digits), channels, ["mm"] * len(channels)
    )
    mask, remarks = tell_missing(markers)
    assert not mask.any()
    assert remarks == ()


CLEAN = [
    path
    for pattern in ("wild/real/*", "wild/cases/0[1-5]*/*", "wild/cases/1*/*")
    for path in shared_like(pattern)
    if path.suffix in {".c3d", ".trc", ".bvh"}
]


@pytest.mark.skipif(not CLEAN, reason="files of laboratories are not beside the repository")
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("path", CLEAN, ids=lambda path: path.name)
def test_nothing_is_told_of_files_of_laboratories_that_mark_gaps(path):
    mask, remarks = tell_missing(format_for(path).read_as_stated(path))
    assert not mask.any()
    assert remarks == ()


@pytest.mark.parametrize("path", shared_like("wild/cases/07*/*.trc"), ids=lambda path: path.name)
def test_zeros_of_opensim_are_told(path):
    mask, _ = tell_missing(format_for(path).read_as_stated(path))
    assert mask.sum() == 90


ANGLES = Recording(
    "a",
    np.arange(6.0),
    [[1.0, 0.0], [1.0, 5.0], [0.0, 5.0], [0.0, -7.0], [2.0, 5.0], [3.0, 5.0]],
    ["hip.rx", "knee.rx"],
    ["deg"] * 2,
)
MARKS = {
    "zeros": [[0, 1], [0, 0], [1, 0], [1, 0], [0, 0], [0, 0]],
    "held": [[0, 0], [1, 0], [0, 1], [1, 0], [0, 0], [0, 1]],
    "5": [[0, 0], [0, 1], [0, 1], [0, 0], [0, 1], [0, 1]],
    "-7.0": [[0, 0], [0, 0], [0, 0], [0, 1], [0, 0], [0, 0]],
    "none": np.zeros((6, 2)),
}


@pytest.mark.parametrize("mark", MARKS)
def test_the_user_settles_what_marks_missing_values(mark):
    mask, remarks = choose_missing_rule(mark)(ANGLES)
    assert np.array_equal(mask, MARKS[mark])
    assert bool(remarks) == mask.any()


def test_of_markers_all_coordinates_are_zero_or_held():
    recording = walking()
    part = marked(recording, 5, [0, 1], 0.0)
    assert not choose_missing_rule("zeros")(part)[0].any()
    still = held(recording, 30, 40, slice(1, 3))
    assert not choose_missing_rule("held")(still)[0].any()
    constant = marked(recording, slice(None), FIRST, 5.0)
    assert not choose_missing_rule("held")(constant)[0].any()


@pytest.mark.parametrize("text", ["", "nan", "zero", "inf", "9,5"])
def test_another_word_is_refused(text):
    with pytest.raises(UsageError, match="--missing: expected zeros, held, none or a number"):
        choose_missing_rule(text)


def test_without_a_word_motion_tells():
    assert choose_missing_rule(None) is tell_missing


def test_a_recording_without_any_value_has_none_to_tell():
    empty = walking().hide(np.ones((1, 1), dtype=bool))
    with warnings.catch_warnings(action="error"):
        mask, remarks = tell_missing(empty)
    assert not mask.any()
    assert remarks == ()


ENTRIES = st.sampled_from([np.nan, 0.0, 1.0, 1.5, -2.0, 9999.0, 1e30, 1e-300])


@given(st.lists(st.lists(ENTRIES, min_size=7, max_size=7), min_size=1, max_size=30))
def test_whatever_stands_in_a_file_only_visible_entries_are_told(rows):
    channels = [*(f"{name}.{axis}" for name in "AB" for axis in "xyz"), "C"]
    recording = Recording("any", np.arange(len(rows)) / 10, rows, channels, ["mm"] * 7)
    with warnings.catch_warnings(action="error"):
        mask, remarks = tell_missing(recording)
    assert not (mask & ~recording.visible).any()
    assert len(remarks) >= mask.any()
    for marker in (slice(0, 3), slice(3, 6)):
        zero = (recording.values[:, marker] == 0.0) & mask[:, marker]
        assert (zero.all(axis=1) == zero.any(axis=1)).all()
