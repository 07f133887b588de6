"""Marks: numbers that add up, names that stay text, and elements with a name."""

import re
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.reports.figures.axes import draw_axes, panels
from mocapbench.reports.figures.marks import (
    SHAPES,
    band,
    coordinate,
    dot,
    group,
    polyline,
    segments,
    svg,
    text,
)
from mocapbench.reports.figures.scale import fit_scale
from mocapbench.reports.figures.styles import DrawingStyle

PLACES = st.floats(-2000.0, 2000.0)
POINTS = arrays(float, st.tuples(st.integers(1, 30), st.just(2)), elements=PLACES)
NUMBER = r"-?(?:\d+\.?\d*|\.\d+)"


def drawn_points(commands):
    """Return the points of each run of a path, its relative steps summed up."""
    runs = re.findall(rf"M({NUMBER}) ?({NUMBER})(?:l([^Mz]*))?", commands)
    return [np.cumsum([(float(x), float(y)), *_pairs(steps)], axis=0) for x, y, steps in runs]


def _pairs(steps):
    numbers = [float(number) for number in re.findall(NUMBER, steps)]
    return list(zip(numbers[::2], numbers[1::2], strict=True))


@given(value=PLACES)
def test_a_coordinate_has_at_most_one_decimal(value):
    assert re.fullmatch(r"-?\d+(\.\d)?", coordinate(value))
    assert float(coordinate(value)) == pytest.approx(value, abs=0.0501)
    assert coordinate(value) != "-0"


@given(points=POINTS)
def test_a_line_goes_through_its_points(points):
    (drawn,) = drawn_points(segments(*points.T))
    np.testing.assert_allclose(drawn, points, atol=0.0501)


def test_nan_breaks_a_line_and_ends_a_band():
    xs, ys = np.arange(7.0), np.array([0.0, 1.0, np.nan, np.nan, 4.0, np.nan, 6.0])
    assert [run[:, 0].tolist() for run in drawn_points(segments(xs, ys))] == [[0, 1], [4], [6]]
    assert band(xs, ys, ys + 1.0).count("z") == 3


def test_a_band_runs_along_its_lower_side_and_back_along_its_upper():
    (outline,) = drawn_points(band(np.array([0.0, 1.0]), np.zeros(2), np.ones(2)))
    assert outline.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]


def test_markers_differ():
    assert len({dot(0.0, 0.0, shape) for shape in range(len(SHAPES))}) == len(SHAPES)
    assert all(len(set(pair)) == 2 for pair in pairwise(SHAPES))


HOSTILE = '<script>"&'


def test_names_are_text_whatever_they_hold():
    marks = [group(DrawingStyle("h1", 0, HOSTILE), text(0.0, 0.0, HOSTILE), title=HOSTILE)]
    root = ElementTree.fromstring(svg(10.0, 10.0, HOSTILE, marks))
    assert root.attrib["aria-label"] == HOSTILE
    assert [element.text for element in root.iter("text")] == [HOSTILE]
    assert [element.text for element in root.iter("title")] == [HOSTILE]
    assert root[0].attrib["data-model"] == HOSTILE


def test_a_panel_is_named_and_writes_what_its_axes_are():
    x, y = fit_scale([0, 1], 40, 300), fit_scale([1, 900], 200, 20)
    line = polyline(x.places(np.array([0.0, 1.0])), y.places(np.array([1.0, 900.0])))
    drawn = draw_axes((x, y), "knee", ("seconds", "cm"), [line], "the knee")
    root = ElementTree.fromstring(panels([drawn]))
    (panel,) = root
    assert panel.attrib["role"] == "img"
    assert panel.attrib["aria-label"] == "the knee"
    assert {"knee", "seconds", "cm", "1", "10", "100"} <= set(panel.itertext())
