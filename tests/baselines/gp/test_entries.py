import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from mocapbench.baselines.gp.entries import Entries

OBSERVED = arrays(bool, array_shapes(min_dims=3, max_dims=3, max_side=4), elements=st.booleans())


@given(OBSERVED)
def test_the_pairs_address_the_grid_of_all_pairs(observed):
    n_units, n_outputs, n_times = observed.shape
    shape = (n_units, n_units, n_outputs, n_times, n_times)
    for d, pairs in enumerate(Entries.of(observed).pairs):
        unit, time = np.nonzero(observed[:, d])
        p, q, output, s, t = np.unravel_index(pairs, shape)
        expected = np.broadcast_arrays(unit[:, None], unit, d, time[:, None], time)
        for axis, wanted in zip((p, q, output, s, t), expected, strict=True):
            np.testing.assert_array_equal(axis, wanted)


@given(OBSERVED, st.integers(1, 3))
def test_placing_what_was_picked_keeps_the_visible_entries_and_clears_the_rest(observed, width):
    values = np.random.default_rng(0).standard_normal((*observed.shape, width))
    entries = Entries.of(observed)
    placed = entries.place(entries.pick(values), width)
    np.testing.assert_array_equal(placed, np.where(observed[..., None], values, 0.0))
