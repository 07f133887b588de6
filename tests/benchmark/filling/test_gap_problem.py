import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.filling.gap_problem import GapProblem, cut_windows
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


@given(STARTS, st.integers(1, 15), st.integers(40, 200), st.integers(0, 2))
def test_every_wanted_entry_is_wanted_in_one_window(starts, length, limit, n_train):
    asked = problem(starts, length, n_train)
    wanted = np.zeros(asked.target.shape, dtype=int)
    try:
        windows = cut_windows(asked, limit)
    except ValueError:  # gaps side by side, longer than any window
        return
    for window, part in windows:
        wanted[window] += part.target
        assert part.n_frames <= limit
        assert not part.given.visible[part.target].any()
    np.testing.assert_array_equal(wanted, asked.target)


def test_what_fits_is_not_cut():
    asked = problem([100], 10)
    for limit in (None, N_FRAMES):
        ((_, part),) = cut_windows(asked, limit)
        assert part is asked


def test_a_window_has_as_much_on_both_sides_of_a_gap():
    ((window, _),) = cut_windows(problem([100], 10), 50)
    assert window == slice(80, 130)


def test_a_gap_longer_than_a_window_is_refused():
    with pytest.raises(ValueError, match="gaps of at most 20 frames, got one of 30"):
        cut_windows(problem([100], 30), 40)


@pytest.mark.parametrize(("limit", "n_windows"), [(60, 1), (59, 2)])
def test_gaps_share_a_window_that_holds_both_and_ten_frames_on_each_side(limit, n_windows):
    assert len(cut_windows(problem([100, 130], 10), limit)) == n_windows
