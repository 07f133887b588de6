import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.common.angle_wrapping import mean_directions, wrapping_offsets
from mocapbench.datasets import Recording

UNITS = ("deg", "rad", "cm")
TURN = np.array([360.0, 2 * np.pi, 0.0])


def recording(values):
    values = np.asarray(values, dtype=float)
    return Recording("r", np.arange(len(values)) / 30, values, ("a", "b", "c"), UNITS)


@given(st.lists(st.integers(-5, 5), min_size=2, max_size=2), st.floats(-179.0, 179.0))
def test_whole_turns_are_told_and_do_not_change_the_mean_direction(turns, angle):
    values = np.tile([angle, np.deg2rad(angle), angle], (4, 1)) + 0.01 * np.eye(4)[:, :3]
    near, moved = recording(values), recording(values + TURN * [*turns, 0])
    directions = mean_directions([near])
    np.testing.assert_allclose(mean_directions([moved]), directions, atol=1e-9)
    np.testing.assert_array_equal(wrapping_offsets(near, directions), 0.0)
    np.testing.assert_allclose(wrapping_offsets(moved, directions), TURN * [*turns, 0], atol=1e-9)


def test_directions_on_both_sides_of_half_a_turn_have_their_mean_there():
    around = recording([[170.0, 0.0, 0.0], [-170.0, 0.0, 0.0]])
    assert abs(mean_directions([around])[0]) == pytest.approx(180.0)


def test_hidden_entries_say_nothing():
    values = np.array([[720.0, np.nan, 5.0], [720.0, np.nan, np.nan]])
    np.testing.assert_array_equal(mean_directions([recording(values)])[1:], 0.0)
    np.testing.assert_array_equal(
        wrapping_offsets(recording(values), np.zeros(3)), [720.0, 0.0, 0.0]
    )
