from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.common.recordings import interpolate_channels
from mocapbench.basics.mask_runs import runs


@given(frames=st.lists(st.booleans(), max_size=30))
def test_runs_are_consecutive_separate_and_cover_all_true_frames(frames):
    frames = np.array(frames, dtype=bool)
    unbroken = runs(frames)
    np.testing.assert_array_equal(np.concatenate([[], *unbroken]), np.flatnonzero(frames))
    assert all((np.diff(run) == 1).all() and len(run) for run in unbroken)
    assert all(after[0] - before[-1] > 1 for before, after in pairwise(unbroken))


@given(st.integers(0, 10_000), st.floats(0.0, 0.9))
def test_lines_stay_lines_between_visible_entries_and_are_held_beyond(seed, share):
    rng = np.random.default_rng(seed)
    times, slopes = np.cumsum(rng.uniform(0.1, 1.0, 12)), rng.normal(size=3)
    line = 2.0 + np.outer(times, slopes)
    values = np.where(rng.random((12, 3)) < share, np.nan, line)
    found = interpolate_channels(values, times)
    for column, given_, whole in zip(found.T, values.T, line.T, strict=True):
        seen = np.flatnonzero(~np.isnan(given_))
        if not len(seen):
            assert np.isnan(column).all()
            continue
        np.testing.assert_allclose(column, whole[np.clip(np.arange(12), seen[0], seen[-1])])


def test_other_times_may_be_asked_for():
    values = np.array([[0.0], [np.nan], [4.0]])
    read = interpolate_channels(values, np.arange(3.0), np.array([-1.0, 0.5, 9.0]))
    np.testing.assert_array_equal(read, [[0.0], [1.0], [4.0]])
