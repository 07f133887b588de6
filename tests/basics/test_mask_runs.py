import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.basics.mask_runs import free_starts


@given(blocked=st.lists(st.booleans(), max_size=20), length=st.integers(1, 22))
def test_a_gap_fits_where_it_and_a_frame_on_both_sides_are_free(blocked, length):
    blocked = np.array(blocked, dtype=bool)
    fits = [n for n in range(1, len(blocked) - length) if not blocked[n - 1 : n + length + 1].any()]
    assert free_starts(blocked, length).tolist() == fits
