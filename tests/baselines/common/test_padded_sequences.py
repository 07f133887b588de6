"""Padding: the arrays that went in come out, and statistics do not see it."""

import numpy as np
import pytest

from mocapbench.baselines.common.padded_sequences import Sequences


@pytest.fixture
def arrays():
    rng = np.random.default_rng(0)
    complete = [rng.normal(size=(n, 2)) for n in (3, 5, 1)]
    return [np.where(rng.random(a.shape) < 0.3, np.nan, a) for a in complete]


def test_padding_is_undone(arrays):
    for given, returned in zip(arrays, Sequences.of(arrays).arrays(), strict=True):
        np.testing.assert_array_equal(given, returned)


def test_statistics_are_those_of_the_visible_entries(arrays):
    sequences = Sequences.of(arrays)
    assert sequences.frames.sum(axis=1).tolist() == [3, 5, 1]
    for k, array in enumerate(arrays):
        np.testing.assert_array_equal(sequences.counts[k], (~np.isnan(array)).sum(axis=0))
        np.testing.assert_allclose(sequences.squares[k], np.nansum(array**2, axis=0))
    assert not sequences.visible[~sequences.frames].any()
    assert not sequences.values[sequences.visible == 0].any()


def test_rows_are_those_of_the_index(arrays):
    (second,) = Sequences.of(arrays).rows(np.array([1])).arrays()
    np.testing.assert_array_equal(second, arrays[1])
