"""A strip shows the values that it is given, and no others."""

import re
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st
from samples import draws

from mocapbench.reports.analysis.units import FoldSample
from mocapbench.reports.figures.intervals import centre, interval
from mocapbench.reports.figures.strip import strip, strip_axis, strip_scale
from mocapbench.reports.figures.styles import DrawingStyle

STYLE = DrawingStyle("h3", 1, "knn <&>")
VALUES = st.lists(st.floats(0.1, 1000.0), min_size=2, max_size=12)


def _marks(svg):
    """Return the x of the marks of each class."""
    paths = [element.attrib for element in ElementTree.fromstring(svg).iter("path")]
    return {
        path["class"]: [float(x) for x in re.findall(r"[MH](-?[\d.]+)", path["d"])]
        for path in paths
    }


@given(values=VALUES)
def test_the_values_can_be_read_back(values):
    scale = strip_scale(values)
    marks = _marks(strip(draws(values), scale, "knn", STYLE))
    assert marks["fold"] == pytest.approx(scale.places(values).tolist(), abs=0.051)
    assert marks["dot"] == pytest.approx([scale.place(centre(draws(values), scale))], abs=0.051)


@given(values=VALUES)
def test_the_interval_is_drawn_from_end_to_end_and_cut_at_the_ends_of_the_scale(values):
    scale = strip_scale(values)
    low, high = interval(draws(values), scale)
    ends = [scale.place(max(low, scale.low)), scale.place(min(high, scale.high))]
    marks = _marks(strip(draws(values), scale, "knn", STYLE))
    assert marks["interval"] == pytest.approx(ends, abs=0.051)


def test_a_single_fold_is_its_dot():
    assert set(_marks(strip(draws([2.0]), strip_scale([1.0, 2.0]), "knn", STYLE))) == {"dot"}


def test_folds_of_one_unit_have_no_interval():
    sample = FoldSample.of([1.0, 2.0, 4.0], ["subject 07"] * 3, ["walk"] * 3)
    assert set(_marks(strip(sample, strip_scale([1.0, 4.0]), "knn", STYLE))) == {"fold", "dot"}


def test_it_names_itself_and_its_model_whatever_its_name():
    root = ElementTree.fromstring(strip(draws([1.0]), strip_scale([1.0]), "<&>, 1 fold", STYLE))
    assert root.attrib["data-model"] == "knn <&>"
    assert root.attrib["aria-label"] == "<&>, 1 fold"
    assert root.attrib["class"] == "strip h3 k1"


def test_a_row_is_small():
    row = strip(draws([1.0, 2.0, 3.0, 4.0]), strip_scale([1.0, 4.0]), "knn", STYLE)
    assert len(row) < 420


def test_the_axis_has_the_ticks_of_the_scale_at_their_places():
    scale = strip_scale([0.0, 10.0])
    texts = list(ElementTree.fromstring(strip_axis(scale, "MSE")).iter("text"))
    assert [float(text.attrib["x"]) for text in texts] == pytest.approx(
        [scale.place(float(text.text)) for text in texts], abs=0.051
    )
