import numpy as np
import pytest

from mocapbench.benchmark.filling.jumps import find_jumps
from mocapbench.datasets import Recording


def rows_of(recording, target):
    return list(find_jumps(recording, target).itertuples(index=False))


def test_the_truth_does_not_jump(waves, hidden):
    assert find_jumps(waves(), hidden((50, 60, [0, 1]))).empty


@pytest.mark.parametrize("amount", [5.0, -7.0])
def test_a_raised_gap_jumps_at_both_edges_by_what_it_was_raised(waves, hidden, amount):
    recording, target = waves(), hidden((50, 60, [1]))
    steps = np.abs(np.diff(recording.values[:, 1]))
    raised = recording.values.copy()
    raised[target] += 10.0 * amount
    first, second = rows_of(recording.with_values(raised), target)
    assert {(j.frame, j.channel) for j in (first, second)} == {(50, 1), (59, 1)}
    assert first.size >= second.size
    assert second.size == pytest.approx(10.0 * abs(amount), abs=steps.max())
    assert first.largest == pytest.approx(np.delete(steps, range(49, 60)).max())


def test_steps_inside_a_gap_and_beside_open_ones_do_not_count(waves, hidden):
    recording, target = waves(), hidden((50, 60, [0]))
    values = recording.values.copy()
    values[54:56, 0] += 90.0
    values[48:50, 0] = np.nan  # stays open, so that nothing visible lies beside the gap there
    assert find_jumps(recording.with_values(values), target).empty


def test_a_channel_that_stands_still_may_be_filled_to_rounding(waves, hidden):
    recording, target = waves(), hidden((50, 60, [0]))
    values = recording.values.copy()
    values[:, 0] = 3.0
    values[50:60, 0] += 1e-9
    assert find_jumps(recording.with_values(values), target).empty
    values[50:60, 0] += 1.0
    (found, _) = rows_of(recording.with_values(values), target)
    assert tuple(found) == (50, 0, pytest.approx(1.0), 0.0)


def test_a_gap_at_the_end_has_one_edge(waves, hidden):
    recording = waves()
    n_frames = len(recording.values)
    target = hidden((n_frames - 5, n_frames, [0]))
    values = recording.values.copy()
    values[target] += 90.0
    (found,) = rows_of(recording.with_values(values), target)
    assert found.frame == n_frames - 5


def test_a_step_that_is_hardly_longer_than_visible_ones_is_no_jump():
    values = np.array([[0.0], [1.0], [0.0], [1.1], [0.0], [1.0], [0.0]])
    recording = Recording("r", np.arange(7.0), values, ("a",), ("mm",))
    target = np.zeros((7, 1), dtype=bool)
    target[3] = True
    assert find_jumps(recording, target).empty
    values[3] = 1.3
    assert {jump.frame for jump in rows_of(recording.with_values(values), target)} == {3}


def test_channels_without_a_unit_have_nothing_in_common():
    values = np.column_stack([1e-4 * np.sin(np.arange(9)), np.full(9, 101325.0)])
    recording = Recording("r", np.arange(9.0), values, ("knee", "pressure"), ("", ""))
    target = np.zeros((9, 2), dtype=bool)
    target[4, 0] = True
    values[4, 0] = 0.08
    assert {jump.channel for jump in rows_of(recording.with_values(values), target)} == {0}


def test_rounding_is_relative_to_channels_of_the_same_unit():
    """A channel that is constantly 0 is filled with what is left of arithmetic in degrees."""
    values = np.column_stack([np.zeros(7), 90.0 * np.sin(np.arange(7)), np.arange(7.0)])
    recording = Recording("r", np.arange(7.0), values, ("a", "b", "c"), ("deg", "deg", "cm"))
    target = np.zeros((7, 3), dtype=bool)
    target[3, 0] = True
    values[3, 0] = 7e-6
    assert find_jumps(recording.with_values(values), target).empty
