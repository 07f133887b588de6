import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from mocapbench.baselines.gp.solvers.entries import Entries, pick_entries, place_entries

OBSERVED = arrays(bool, array_shapes(min_dims=3, max_dims=3, max_side=4), elements=st.booleans())


@given(OBSERVED)
def test_the_rows_are_the_visible_entries(observed):
    entries = Entries.of(observed)
    rows = np.zeros_like(observed)
    rows[entries.unit, :, entries.time] = entries.visible.T
    np.testing.assert_array_equal(rows, observed)
    assert entries.visible.any(axis=0).all()
    for p, span in enumerate(entries.spans):
        assert (entries.unit[span] == p).all()


@given(OBSERVED, st.integers(0, 99))
def test_place_after_pick_keeps_visible_pairs_and_sets_all_others_to_zero(observed, seed):
    entries = Entries.of(observed)
    matrices = np.random.default_rng(seed).standard_normal(entries.shape)
    for d, (matrix, seen) in enumerate(zip(matrices, entries.visible, strict=True)):
        placed = np.full_like(matrix, np.nan)
        positions = entries.positions[d]
        place_entries(pick_entries(matrix, positions), positions, placed)
        np.testing.assert_array_equal(placed, np.where(np.outer(seen, seen), matrix, 0.0))


@given(OBSERVED, st.integers(0, 99))
def test_folding_is_the_adjoint_of_unfolding(observed, seed):
    entries, rng = Entries.of(observed), np.random.default_rng(seed)
    loadings = rng.standard_normal(len(observed)) * rng.integers(0, 2, len(observed))
    curves = rng.standard_normal((entries.n_times, 2))
    values = rng.standard_normal((len(entries.unit), 2))
    unfolded, folded = entries.unfold(loadings, curves), entries.fold(loadings, values)
    np.testing.assert_allclose(np.vdot(values, unfolded), np.vdot(folded, curves), atol=1e-12)


@given(OBSERVED, st.integers(0, 99))
def test_a_block_unfolds_along_rows_and_columns(observed, seed):
    entries, rng = Entries.of(observed), np.random.default_rng(seed)
    rows, columns = rng.standard_normal((2, len(observed)))
    block = rng.standard_normal((entries.n_times, entries.n_times))
    total = np.ones(entries.shape[1:])
    entries.add_unfolded(rows, columns, block, total)
    expected = 1.0 + entries.unfold(rows, entries.unfold(columns, block.T).T)
    np.testing.assert_allclose(total, expected, atol=1e-12)


@given(OBSERVED)
def test_the_chunks_are_all_outputs_in_order(observed):
    n_outputs = observed.shape[1]
    listed = [d for run in Entries.of(observed).chunks for d in range(*run.indices(n_outputs))]
    assert listed == list(range(n_outputs))
