from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.common.checks import (
    check_channels,
    check_rates,
    check_recordings,
    check_spread,
    check_visible,
    pool,
)
from mocapbench.baselines.common.recordings import by_content, places_by_content, visible_moments
from mocapbench.datasets import Recording


def recording(name, values, unit=""):
    values = np.asarray(values, dtype=float)
    channels = tuple(f"c{d}" for d in range(values.shape[1]))
    return Recording(name, np.arange(len(values)), values, channels, (unit,) * len(channels))


@given(seed=st.integers(0, 2**32 - 1))
def test_moments_are_those_of_the_visible_entries(seed):
    rng = np.random.default_rng(seed)
    values = rng.normal(5.0, 2.0, (12, 3))
    values[1:][rng.random((11, 3)) < 0.5] = np.nan
    mean, variance = visible_moments([recording("a", values[:5]), recording("b", values[5:])])
    np.testing.assert_allclose(mean, np.nanmean(values, axis=0))
    np.testing.assert_allclose(variance, np.nanvar(values, axis=0), atol=1e-15)


CONTENTS = st.lists(
    st.tuples(*[st.sampled_from([-1.0, 0.0, 2.5, np.nan])] * 2), min_size=1, max_size=6, unique=True
)


@given(contents=CONTENTS, data=st.data())
def test_what_is_in_the_order_of_contents_comes_back_in_the_order_given(contents, data):
    names = data.draw(st.permutations([f"r{number}" for number in range(len(contents))]))
    given = [recording(name, [values]) for name, values in zip(names, contents, strict=True)]
    ordered = by_content(given)
    assert [ordered[place] for place in places_by_content(given)] == given


@given(contents=CONTENTS, data=st.data(), factor=st.sampled_from([1e-3, 0.1, 57.3]))
def test_neither_names_nor_units_nor_where_a_recording_stands_change_the_order(
    contents, data, factor
):
    given = [recording(f"r{number}", [values]) for number, values in enumerate(contents)]
    names = data.draw(st.permutations([one.name for one in given]))
    others = [
        recording(name, factor * one.values)
        for name, one in zip(names, data.draw(st.permutations(given)), strict=True)
    ]
    for one, other in zip(by_content(given), by_content(others), strict=True):
        np.testing.assert_array_equal(other.values, factor * one.values)


def test_shorter_recordings_come_first_and_of_equal_values_the_faster():
    long, short = recording("a", [[0.0], [1.0]]), recording("b", [[5.0]])
    fast = replace(long, name="c", times=long.times / 2)
    assert [one.name for one in by_content([long, short, fast])] == ["b", "c", "a"]


def test_moments_of_a_channel_without_visible_entries_are_nan():
    mean, variance = visible_moments([recording("a", [[np.nan, 1.0]])])
    np.testing.assert_array_equal([mean, variance], [[np.nan, 1.0], [np.nan, 0.0]])


def test_a_pool_has_each_name_once_as_given_to_impute():
    fitted = [recording("a", [[1.0]]), recording("b", [[2.0]])]
    given = [recording("b", [[3.0]]), recording("c", [[4.0]])]
    assert [one.values.item() for one in pool(fitted, given)] == [1.0, 3.0, 4.0]


def test_a_channel_visible_nowhere_is_named():
    with pytest.raises(ValueError, match=r"got none of \['c1'\]"):
        check_visible([recording("a", [[1.0, np.nan]]), recording("b", [[1.0, np.nan]])])


CHECKS = {
    "fit": check_recordings,
    "impute": lambda given: check_channels(given, ("c0",), ("mm",)),
    "both": lambda given: pool([], given),
}


@pytest.mark.parametrize("check", CHECKS.values(), ids=CHECKS)
def test_recordings_in_different_units_are_refused(check):
    given = [recording("a", [[1.0]], "mm"), recording("b", [[2.0]], "deg")]
    with pytest.raises(ValueError, match=r"'b': expected channel 'c0' in unit 'mm' as .*, got"):
        check(given)


@pytest.mark.parametrize("check", CHECKS.values(), ids=CHECKS)
@pytest.mark.parametrize(
    ("given", "got"),
    [
        (recording("a", [[1.0]]), "Recording; put one or more into a list"),
        (None, "NoneType"),
        (np.zeros((3, 1)), "ndarray of ndarray"),
        ([np.zeros((3, 1))], "list of ndarray"),
        ("a.csv", "str of str"),
    ],
    ids=lambda value: type(value).__name__,
)
def test_what_is_no_sequence_of_recordings_is_refused(check, given, got):
    with pytest.raises(ValueError, match=f"expected a sequence of Recordings, got {got}"):
        check(given)


def test_recordings_given_to_fit_and_impute_have_the_same_units():
    with pytest.raises(ValueError, match="in unit 'mm' as in the other recordings, got 'deg'"):
        pool([recording("a", [[1.0]], "mm")], [recording("b", [[2.0]], "deg")])


def test_one_visible_entry_tells_nothing_of_a_channels_spread():
    once, never = recording("a", [[1.0], [np.nan]]), recording("b", [[np.nan]])
    with pytest.raises(ValueError, match=r"at least two visible entries .* got one of \['c0'\]"):
        check_spread([once, never])
    check_spread([once, recording("b", [[1.0]])])
    check_spread([never])


def test_rates_may_differ_by_rounding_and_a_single_frame_has_any():
    exact = recording("exact", np.zeros((30, 1)))
    rounded = replace(exact, name="rounded", times=exact.times * 1.005)
    check_rates([exact.frames([0]), exact, replace(exact.frames([5]), name="one"), rounded])
    check_rates([exact.frames([0])])
    slow = replace(exact, name="slow", times=exact.times * 1.1)
    with pytest.raises(ValueError, match=r"'slow': expected 1 frames .*'exact', got 0\.909091; "):
        check_rates([exact.frames([0]), exact, slow])
