from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.common.gaps import runs


@given(frames=st.lists(st.booleans(), max_size=30))
def test_runs_are_consecutive_separate_and_cover_all_true_frames(frames):
    frames = np.array(frames, dtype=bool)
    unbroken = runs(frames)
    np.testing.assert_array_equal(np.concatenate([[], *unbroken]), np.flatnonzero(frames))
    assert all((np.diff(run) == 1).all() and len(run) for run in unbroken)
    assert all(after[0] - before[-1] > 1 for before, after in pairwise(unbroken))
