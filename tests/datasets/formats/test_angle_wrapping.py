"""Angles are unwrapped on the way in and wrapped on the way out."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.datasets import Recording, unwrap_angles
from mocapbench.datasets.formats.angle_wrapping import (
    mean_directions,
    wrap_angles,
    wrapping_offsets,
)

TURN = {"deg": 360.0, "rad": 2 * np.pi}
CURVES = st.lists(st.floats(-0.45, 0.45), min_size=2, max_size=40).map(np.cumsum)
"""Angles in turns, less than half a turn apart."""
UNITS = st.sampled_from(["deg", "rad"])


def one_channel(angles, unit):
    times = np.arange(len(angles)) / 100.0
    return Recording("turning", times, np.reshape(angles, (-1, 1)), ["root.ry"], [unit])


def fold(angles, low, turn):
    return angles - turn * np.floor((angles - low) / turn)


@st.composite
def gaps(draw, curves=CURVES):
    """Draw a curve in turns and a mask that leaves its first entry visible."""
    curve = draw(curves)
    hidden = np.array([False, *draw(st.lists(st.booleans(), min_size=39, max_size=39))])
    return curve, hidden[: len(curve)]


@given(CURVES, UNITS, st.sampled_from([-0.5, 0.0]))
def test_unwrapping_undoes_wrapping_up_to_whole_turns(curve, unit, low):
    curve = TURN[unit] * curve
    again = unwrap_angles(one_channel(fold(curve, low * TURN[unit], TURN[unit]), unit)).values[:, 0]
    turns = (again - curve) / TURN[unit]
    assert np.allclose(turns, np.round(turns[0]), atol=1e-9)


@given(gaps(), UNITS, st.sampled_from([-0.5, 0.0]))
def test_what_is_filled_returns_to_the_range_of_the_file(curve_and_gap, unit, low):
    curve, hidden = curve_and_gap
    turn = TURN[unit]
    file = one_channel(fold(turn * curve, low * turn, turn), unit)
    new = hidden[:, None]
    raw = file.hide(new)
    filled = unwrap_angles(file).values + (
        unwrap_angles(raw).values[0] - unwrap_angles(file).values[0]
    )
    out = wrap_angles(filled, raw, new)[hidden, 0]
    seen = raw.values[~hidden, 0]
    if (np.abs(seen) <= turn / 2).all():
        assert ((out >= -turn / 2) & (out <= turn / 2)).all()
    elif ((seen >= 0) & (seen <= turn)).all():
        assert ((out >= 0) & (out <= turn)).all()
    error = (out - file.values[hidden, 0]) / turn
    assert np.allclose(error, np.round(error), atol=1e-9)


@given(CURVES, st.integers(2, 5))
def test_a_file_that_counts_turns_goes_on_counting(curve, turns):
    """What a file without jumps has beyond ±180° stays there."""
    curve = np.concatenate([[0.0, 0.4, 0.8], 0.8 + 0.4 * np.arange(1, 4 * turns), [*curve[:1] * 0]])
    curve = 360.0 * curve[:-1]
    new = np.zeros((len(curve), 1), dtype=bool)
    new[3:6] = True
    raw = one_channel(curve, "deg").hide(new)
    filled = np.interp(np.arange(len(curve)), np.flatnonzero(~new), unwrap_angles(raw).values[~new])
    out = wrap_angles(filled[:, None], raw, new)[3:6, 0]
    error = (out - filled[3:6]) / 360.0
    assert np.allclose(error, np.round(error), atol=1e-9)
    assert np.abs(np.diff([curve[2], *out])).max() < 360.0


@pytest.mark.parametrize("unit", ["", "cm", "mm", "deg/s"])
def test_what_is_no_angle_is_left_alone(unit):
    values = np.array([170.0, np.nan, -175.0, 9000.0])
    file = one_channel(values, unit)
    assert np.array_equal(unwrap_angles(file).values[:, 0], values, equal_nan=True)
    new = np.isnan(file.values)
    assert np.array_equal(wrap_angles(np.full((4, 1), 500.0), file, new), np.full((4, 1), 500.0))


def test_neighbours_across_a_gap_are_neighbours():
    file = one_channel([170.0, np.nan, np.nan, -170.0], "deg")
    assert unwrap_angles(file).values[3, 0] == 190.0


@pytest.mark.parametrize("values", [[np.nan], [np.nan, np.nan, np.nan], [200.0]])
def test_little_is_enough(values):
    file = one_channel(values, "deg")
    assert np.array_equal(unwrap_angles(file).values, file.values, equal_nan=True)
    new = np.ones((len(values), 1), dtype=bool)
    out = wrap_angles(np.full((len(values), 1), 190.0), file.hide(new), new)
    assert (out == -170.0).all()


@pytest.mark.parametrize("seen", [[180.0, 170.0], [-180.0, 180.0], [-180.0, -170.0]])
def test_an_angle_of_exactly_half_a_turn_lies_in_the_range_of_half_a_turn(seen):
    file = one_channel([*seen, np.nan], "deg")
    new = np.isnan(file.values)
    for filled, written in ((190.0, -170.0), (-190.0, 170.0), (-180.0, -180.0)):
        assert wrap_angles(np.array([*seen, filled])[:, None], file, new)[2, 0] == written


@pytest.mark.parametrize("seen", [[0.0, 190.0], [360.0, 190.0]])
def test_an_angle_of_exactly_none_or_one_turn_lies_in_the_range_of_one_turn(seen):
    file = one_channel([*seen, np.nan], "deg")
    new = np.isnan(file.values)
    for filled, written in ((-10.0, 350.0), (370.0, 10.0)):
        assert wrap_angles(np.array([*seen, filled])[:, None], file, new)[2, 0] == written


TURNS = np.array([360.0, 2 * np.pi, 0.0])
"""Of each channel of `of_three_units`."""


def of_three_units(values):
    values = np.asarray(values, dtype=float)
    return Recording(
        "r", np.arange(len(values)) / 30, values, ("a", "b", "c"), ("deg", "rad", "cm")
    )


@given(st.lists(st.integers(-5, 5), min_size=2, max_size=2), st.floats(-179.0, 179.0))
def test_whole_turns_are_told_and_do_not_change_the_mean_direction(turns, angle):
    values = np.tile([angle, np.deg2rad(angle), angle], (4, 1)) + 0.01 * np.eye(4)[:, :3]
    near, moved = of_three_units(values), of_three_units(values + TURNS * [*turns, 0])
    directions = mean_directions([near])
    np.testing.assert_allclose(mean_directions([moved]), directions, atol=1e-9)
    np.testing.assert_array_equal(wrapping_offsets(near, directions), 0.0)
    np.testing.assert_allclose(wrapping_offsets(moved, directions), TURNS * [*turns, 0], atol=1e-9)


def test_directions_on_both_sides_of_half_a_turn_have_their_mean_there():
    around = of_three_units([[170.0, 0.0, 0.0], [-170.0, 0.0, 0.0]])
    assert abs(mean_directions([around])[0]) == pytest.approx(180.0)


def test_hidden_entries_say_nothing():
    values = np.array([[720.0, np.nan, 5.0], [720.0, np.nan, np.nan]])
    np.testing.assert_array_equal(mean_directions([of_three_units(values)])[1:], 0.0)
    np.testing.assert_array_equal(
        wrapping_offsets(of_three_units(values), np.zeros(3)), [720.0, 0.0, 0.0]
    )
