import numpy as np

from mocapbench.baselines.gp.reduction.reduction import Replicates
from mocapbench.datasets import Recording

NAN = np.nan


def _recording(name, times, values):
    return Recording(name, times, values, ("a", "b"), ("", ""))


def test_the_grid_is_the_union_of_visible_times():
    one = _recording("one", [0.0, 1.0, 2.0], [[1, 2], [NAN, NAN], [3, NAN]])
    two = _recording("two", [0.5, 2.0], [[4, 5], [6, 7]])
    replicates = Replicates.align([one, two])
    np.testing.assert_array_equal(replicates.times, [0.0, 0.5, 2.0])
    np.testing.assert_array_equal(replicates.data[0], [[1, 0, 3], [2, 0, 0]])
    np.testing.assert_array_equal(replicates.data[1], [[0, 4, 6], [0, 5, 7]])
    np.testing.assert_array_equal(replicates.observed[0], [[1, 0, 1], [1, 0, 0]])


def test_replicates_with_the_same_visible_entries_form_a_pattern():
    observed = np.array([[[1, 1]], [[1, 0]], [[1, 1]], [[0, 0]]], dtype=bool)
    data = np.where(observed, [[[1.0, 3.0]], [[5.0, 5.0]], [[3.0, 9.0]], [[7.0, 7.0]]], 0.0)
    replicates = Replicates(np.arange(2.0), data, observed)
    assert [members.tolist() for members, _ in replicates.patterns] == [[0, 2], [1]]
    assert [seen.tolist() for _, seen in replicates.patterns] == [[[True, True]], [[True, False]]]
