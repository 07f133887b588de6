from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.benchmark.filling.gap_problem import (
    GapProblem,
    cut_blank_ends,
    cut_windows,
    drop_unseen,
    select_channels,
)
from mocapbench.datasets import Recording

N_FRAMES = 300


def problem(starts, length, n_train=0):
    target = np.zeros((N_FRAMES, 2), dtype=bool)
    for start in starts:
        target[start : start + length, start % 2] = True
    times = np.arange(N_FRAMES) / 10
    whole = Recording("r", times, np.ones((N_FRAMES, 2)), ("a", "b"), ("", ""))
    train = tuple(
        Recording(f"t{k}", times, np.ones((N_FRAMES, 2)), ("a", "b"), ("", ""))
        for k in range(n_train)
    )
    return GapProblem(whole.hide(target), target, train)


STARTS = st.lists(st.integers(0, N_FRAMES - 20), min_size=1, max_size=6)


@given(STARTS, st.integers(1, 15), st.integers(40, 3 * N_FRAMES), st.integers(0, 2))
def test_every_wanted_entry_is_wanted_in_one_window(starts, length, limit, n_train):
    asked = problem(starts, length, n_train)
    wanted = np.zeros(asked.target.shape, dtype=int)
    try:
        windows = cut_windows(asked, limit)
    except ValueError as error:  # gaps side by side, longer than any window
        assert "expected gaps of at most" in str(error)
        return
    for window, part in windows:
        assert 0 <= window.start < window.stop <= N_FRAMES
        assert len(part.given.times) == window.stop - window.start
        wanted[window] += part.target
        assert part.n_frames <= limit
        assert not part.given.visible[part.target].any()
    np.testing.assert_array_equal(wanted, asked.target)


def test_what_fits_is_not_cut():
    asked = problem([100], 10)
    for limit in (None, N_FRAMES):
        ((window, part),) = cut_windows(asked, limit)
        assert part is asked
        assert window == slice(0, N_FRAMES)


def test_a_window_has_as_much_on_both_sides_of_a_gap():
    ((window, _),) = cut_windows(problem([100], 10), 50)
    assert window == slice(80, 130)


@pytest.mark.parametrize("n_train", [1, 2])
def test_training_has_half_of_the_frames_and_shares_them(n_train):
    asked = problem([100], 10, n_train)
    ((_, part),) = cut_windows(asked, 100)
    assert len(part.given.times) == 50
    for short, whole in zip(part.train, asked.train, strict=True):
        np.testing.assert_array_equal(short.times, whole.times[: 50 // n_train])


def test_what_training_leaves_over_is_of_the_recording_to_fill():
    asked = problem([100], 10, n_train=1)
    short = replace(asked, train=(asked.train[0].frames(np.arange(5)),))
    ((_, part),) = cut_windows(short, 100)
    assert [len(recording.times) for recording in (part.given, *part.train)] == [95, 5]


@pytest.mark.parametrize("start", [0, 100, 290])
def test_a_window_with_room_for_all_frames_has_them_all(start):
    ((window, _),) = cut_windows(problem([start], 10, n_train=2), 800)
    assert window == slice(0, N_FRAMES)


@pytest.mark.parametrize(("limit", "most"), [(40, 20), (10, 0)])
def test_a_gap_longer_than_a_window_is_refused(limit, most):
    with pytest.raises(ValueError, match=f"gaps of at most {most} frames, got one of 30"):
        cut_windows(problem([100], 30), limit)


def test_the_longest_gap_that_the_refusal_allows_is_taken():
    ((_, part),) = cut_windows(problem([100], 20), 40)
    assert part.target.sum() == 20


def test_a_window_at_an_end_has_as_many_frames_as_any():
    for start in (0, 2, 288, 290):
        ((window, _),) = cut_windows(problem([start], 10), 50)
        assert window in (slice(0, 50), slice(250, 300))


def test_gaps_share_a_window_with_the_gap_before_whatever_came_earlier():
    assert len(cut_windows(problem([20, 130, 160], 10), 60)) == 2


@pytest.mark.parametrize(("limit", "n_windows"), [(60, 1), (59, 2)])
def test_gaps_share_a_window_that_holds_both_and_ten_frames_on_each_side(limit, n_windows):
    assert len(cut_windows(problem([100, 130], 10), limit)) == n_windows


MASKS = arrays(bool, (7, 3))


def masked(visible, target, train=()):
    """Return the problem of filling what is wanted of what is not visible; train likewise."""
    names, times = ("a", "b", "c"), np.arange(7) / 10
    given, *others = (
        Recording("r", times, np.where(mask, 1.0, np.nan), names, ("",) * 3)
        for mask in (visible, *train)
    )
    return GapProblem(given, target & ~visible, tuple(others))


@given(MASKS, MASKS, st.lists(MASKS, max_size=2))
def test_channels_stay_that_are_seen_somewhere_or_wanted(visible, target, train):
    asked = masked(visible, target, train)
    seen = np.sum([mask.sum(axis=0) for mask in (visible, *train)], axis=0) > 1
    kept = seen | asked.target.any(axis=0)
    assume(kept.any())
    left = drop_unseen(asked)
    assert left.given.channels == tuple(np.array(["a", "b", "c"])[kept])
    assert {recording.channels for recording in left.train} <= {left.given.channels}
    np.testing.assert_array_equal(left.target, asked.target[:, kept])
    np.testing.assert_array_equal(left.given.visible, visible[:, kept])


@given(MASKS, MASKS)
def test_frames_at_the_ends_go_where_nothing_is_visible_or_wanted(visible, target):
    asked = masked(visible, target)
    (needed,) = np.nonzero((visible | asked.target).any(axis=1))
    assume(len(needed))
    left, frames = cut_blank_ends(asked), slice(needed[0], needed[-1] + 1)
    np.testing.assert_array_equal(left.given.times, asked.given.times[frames])
    np.testing.assert_array_equal(left.target, asked.target[frames])


def test_recordings_of_which_all_channels_stay_are_not_copied():
    asked = masked(*np.ones((2, 7, 3), dtype=bool), train=np.ones((1, 7, 3), dtype=bool))
    left = select_channels(asked, np.ones(3, dtype=bool))
    assert left.given is asked.given
    assert left.train[0] is asked.train[0]
