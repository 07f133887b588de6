"""Laws of a recording: immutable, consistent, with hidden entries."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.datasets import Recording


def recorded(values, channels=("a", "b", "c")):
    return Recording("r", np.arange(len(values)), values, channels, ("deg",) * len(channels))


VALUES = np.arange(12.0).reshape(4, 3)
entries = arrays(np.bool_, (4, 3))


def test_it_keeps_copies_that_cannot_be_changed():
    values = VALUES.copy()
    recording = recorded(values)
    values[0, 0] = 99.0
    assert recording.values[0, 0] == 0.0
    for array in (recording.values, recording.times):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


@given(entries)
def test_hidden_entries_are_those_that_are_not_visible(hidden):
    recording = recorded(VALUES).hide(hidden)
    np.testing.assert_array_equal(recording.visible, ~hidden)
    np.testing.assert_array_equal(recording.values[~hidden], VALUES[~hidden])


@given(entries, entries)
def test_hiding_twice_hides_both(first, second):
    both = recorded(VALUES).hide(first).hide(second)
    np.testing.assert_array_equal(both.values, recorded(VALUES).hide(first | second).values)


@pytest.mark.parametrize("mask", [[[False], [True], [True], [False]], [[False, True, False]]])
def test_a_mask_may_be_one_for_all_channels_or_for_all_frames(mask):
    hidden = np.broadcast_to(mask, VALUES.shape)
    np.testing.assert_array_equal(recorded(VALUES).hide(mask).visible, ~hidden)


@pytest.mark.parametrize(
    ("hidden", "got"),
    [
        ([0, 1, 2], r"int64 of shape \(3,\)"),
        (slice(1, 3), r"object of shape \(\)"),
        (True, r"bool of shape \(\)"),
        ([True, False, True], r"bool of shape \(3,\)"),
        (np.ones((3, 3), dtype=bool), r"bool of shape \(3, 3\)"),
        (np.ones((1, 4, 3), dtype=bool), r"bool of shape \(1, 4, 3\)"),
        (np.ones((4, 3)), r"float64 of shape \(4, 3\)"),
    ],
    ids=str,
)
def test_what_is_no_mask_hides_nothing(hidden, got):
    expected = rf"'r': expected True or False .* of shape \(4, 3\) \(times, channels\), got {got}"
    with pytest.raises(ValueError, match=expected):
        recorded(VALUES).hide(hidden)


@given(st.permutations("abc"), st.integers(0, 3))
def test_selection_follows_the_names(order, n):
    chosen = recorded(VALUES).select(order[:n])
    assert chosen.channels == tuple(order[:n])
    assert chosen.units == ("deg",) * n
    np.testing.assert_array_equal(chosen.values, VALUES[:, ["abc".index(c) for c in order[:n]]])


def test_an_unknown_channel_cannot_be_selected():
    with pytest.raises(ValueError, match=r"no channels \['d'\]"):
        recorded(VALUES).select(["a", "d"])


def test_a_string_is_no_list_of_channels():
    """It would be taken as one name per letter."""
    with pytest.raises(ValueError, match=r"expected channels .* got the string 'ab'"):
        recorded(VALUES).select("ab")


@pytest.mark.parametrize(
    "index",
    [[1, 3], [1.0, 3.0], [False, True, False, True], np.array([-3, -1])],
    ids=str,
)
def test_frames_are_those_of_indices_or_of_a_mask(index):
    np.testing.assert_array_equal(recorded(VALUES).frames(index).values, VALUES[[1, 3]])


@pytest.mark.parametrize(
    "index",
    [None, "ab", 1, [[0, 1]], [0.5], [np.nan], [True, False], np.ones((4, 3), bool), [4], [-5]],
    ids=str,
)
def test_what_is_neither_indices_nor_a_mask_has_no_frames(index):
    with pytest.raises(ValueError, match=r"'r': expected a list of indices of its 4 frames.*, got"):
        recorded(VALUES).frames(index)


@pytest.mark.parametrize("index", [[], np.zeros(4, dtype=bool)], ids=str)
def test_a_recording_may_have_no_frames(index):
    assert recorded(VALUES).frames(index).values.shape == (0, 3)


def test_frames_keep_their_times():
    some = recorded(VALUES).frames([1, 3])
    np.testing.assert_array_equal(some.times, [1, 3])
    np.testing.assert_array_equal(some.values, VALUES[[1, 3]])


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ({"values": VALUES[:3]}, r"shape \(4, 3\)"),
        ({"values": VALUES[:, :2]}, r"shape \(4, 3\)"),
        ({"channels": ("a", "b", "a")}, "distinct"),
        ({"units": ("deg", "deg")}, "one unit for each"),
        ({"units": "deg"}, "units to be .* one string per channel, got the string 'deg'"),
        ({"channels": "abc"}, "channels to be .* one string per channel, got the string 'abc'"),
        ({"units": None}, "units to be .* one string per channel, got None"),
        ({"units": ("deg", None, "cm")}, "units to be .* one string per channel, got "),
        ({"channels": (1, 2, 3)}, r"channels to be .* one string per channel, got \(1, 2, 3\)"),
        ({"name": None}, "name of a recording to be a string, got None"),
        ({"times": [0, 1, 1, 2]}, "increasing times, got 1.0 after 1.0; sort"),
        ({"times": [0, 2, 1, 3]}, "increasing times, got 1.0 after 2.0; sort"),
        ({"times": [0, 1, np.nan, 2]}, "increasing times, got NaN or infinity"),
        ({"times": np.arange(4)[:, None]}, r"times of shape \(N,\), .*got shape \(4, 1\)"),
        ({"times": None}, r"times of shape \(N,\), .*got shape \(\)"),
        ({"times": "abc"}, "times of recording 'r' to be real numbers, .* got an array of <U3"),
        ({"values": VALUES + 1j}, "values of recording 'r' to be real .* got an array of complex"),
        ({"values": [[1.0], [1.0, 2.0]]}, "values of recording 'r' to be .* of the same length"),
        ({"values": [["a", None, 1.0]] * 4}, "values of recording 'r' to be real .* got others"),
        ({"values": np.where(VALUES == 5, np.inf, VALUES)}, "infinity"),
    ],
)
def test_what_does_not_fit_is_refused(fields, expected):
    right = {
        "name": "r",
        "times": np.arange(4),
        "values": VALUES,
        "channels": ("a", "b", "c"),
        "units": ("deg",) * 3,
    }
    with pytest.raises(ValueError, match=expected):
        Recording(**{**right, **fields})
