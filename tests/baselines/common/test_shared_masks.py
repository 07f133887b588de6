"""Which sequences share a mask, and how hidden entries are bridged for a start."""

import numpy as np

from mocapbench.baselines.common.padded_sequences import Sequences

X = np.nan


def test_masks_that_agree_as_far_as_both_go_are_one_group():
    data = Sequences.of(
        [
            np.array([[1.0], [2.0]]),
            np.array([[1.0], [X], [3.0]]),
            np.array([[5.0], [6.0], [7.0], [X]]),
            np.array([[8.0], [X]]),
        ]
    )
    assert data.leaders.tolist() == [1, 2]
    assert data.groups.tolist() == [1, 0, 1, 0]


def test_rows_are_padded_to_the_longest_of_them():
    data = Sequences.of([np.zeros((5, 1)), np.ones((2, 1)), np.full((3, 1), 2.0)])
    rows = data.rows(np.array([2, 1]))
    assert rows.values.shape == (2, 3, 1)
    assert [array[:, 0].tolist() for array in rows.arrays()] == [[2.0] * 3, [1.0] * 2]
    assert rows.groups.tolist() == [0, 0]


def test_hidden_entries_are_on_lines_between_visible_ones():
    data = Sequences.of([np.array([[X, X], [1.0, X], [X, X], [3.0, X]])])
    (filled,) = data.interpolate_hidden()
    np.testing.assert_array_equal(filled, [[1.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])
