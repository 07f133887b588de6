"""Thinning leaves out points, and no point ends up far from the line."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.reports.figures.pictures.thinning import TOLERANCE, thin_points

POINTS = arrays(
    float, st.tuples(st.integers(1, 40), st.just(2)), elements=st.floats(-200, 200).map(float)
)


def _distance(point, line):
    """Return the distance of a point from a line through points."""
    starts, steps = line[:-1], np.diff(line, axis=0)
    if not len(steps):
        return float(np.hypot(*(point - line[0])))
    lengths = np.maximum((steps**2).sum(axis=1), 1e-12)
    shares = np.clip(((point - starts) * steps).sum(axis=1) / lengths, 0.0, 1.0)
    return float(np.hypot(*(point - starts - shares[:, None] * steps).T).min())


@given(points=POINTS)
def test_no_point_moves_by_more_than_half_a_pixel(points):
    line = thin_points(points)
    assert all(_distance(point, line) <= TOLERANCE + 1e-6 for point in points)
    rounding = np.hypot(0.05, 0.05)
    assert TOLERANCE + rounding <= 0.5


@given(points=POINTS)
def test_the_ends_stay_and_nothing_is_added(points):
    line = thin_points(points)
    assert (line[[0, -1]] == points[[0, -1]]).all()
    assert len(line) <= len(points)
    assert {tuple(point) for point in line} <= {tuple(point) for point in points}


def test_a_straight_line_keeps_its_ends_only_on_either_side_of_a_gap():
    points = np.column_stack([np.arange(9.0), np.arange(9.0)])
    points[4] = np.nan
    np.testing.assert_array_equal(thin_points(points)[:, 0], [0.0, 3.0, np.nan, 5.0, 8.0])
