import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from mocapbench.reports import Band, Curve, Illustration, Panel, render
from mocapbench.reports.figures.panels import draw

X = np.arange(5.0)
WALK, RUN = Curve(X, X**2, "walk"), Curve(X, np.array([0.0, 1.0, np.nan, 3.0, 4.0]), "run")
ILLUSTRATION = Illustration(
    task="toy-interpolation-1",
    title="Two gaits",
    caption="what <b>is</b> seen.",
    panels=(
        Panel("before", "time, s", "angle, deg", (WALK, RUN, WALK)),
        Panel("after $x$", "cycles", "angle, deg", (RUN,)),
    ),
)


@pytest.fixture(scope="module")
def drawing():
    return draw(ILLUSTRATION)


def test_groups_come_in_order_of_appearance_and_have_one_key_each(drawing):
    assert ILLUSTRATION.groups == ("walk", "run")
    assert [key.label for key in drawing.legend] == ["walk", "run"]


def test_it_is_xml_with_a_name_and_says_what_is_along_its_axes(drawing):
    root = ElementTree.fromstring(drawing.svg)
    assert root.attrib["role"] == "img"
    assert root.attrib["aria-label"] == "Two gaits: 2 panels"
    text = "".join(root.itertext())
    panels = ILLUSTRATION.panels
    assert all(name in text for p in panels for name in (p.title, p.x_label, p.y_label))


def test_curves_of_a_group_look_alike_and_those_of_two_do_not(drawing):
    styles = [re.findall(r'style="([^"]*stroke[^"]*)"', key.swatch) for key in drawing.legend]
    assert styles[0] != styles[1]
    assert [drawing.svg.count(style) for (style,) in styles] == [2, 2]
    assert "dasharray" in styles[1][0]


def test_a_gap_breaks_the_line(drawing):
    whole = draw(replace(ILLUSTRATION, panels=(Panel("", "", "", (Curve(X, X, "run"),)),)))
    broken = draw(replace(ILLUSTRATION, panels=(Panel("", "", "", (RUN,)),)))
    assert _strokes(broken) == _strokes(whole) + 1


def _strokes(drawing):
    (line,) = re.findall(r'<path d="([^"]*)"[^>]*stroke: var\(--series-0\)', drawing.svg)
    return line.count("M")


def test_the_same_illustration_gives_the_same_bytes(drawing):
    assert draw(ILLUSTRATION) == drawing


def test_colours_are_left_to_the_page(drawing):
    assert "var(--series-1)" in drawing.svg
    assert not re.findall(r"(?:fill|stroke): #[0-9a-f]+", drawing.svg)


def test_a_page_shows_it_in_the_section_of_its_task(bundle, page):
    shown = render(replace(bundle, illustrations=(ILLUSTRATION,)))
    section = shown[shown.index('<h2 id="task-toy-interpolation-1"') :]
    assert "Two gaits" in section[: section.index("<h2", 10)]
    assert "what &lt;b&gt;is&lt;/b&gt; seen." in shown
    assert "Two gaits" not in page


def test_ids_of_a_page_stay_unique(bundle):
    other = replace(ILLUSTRATION, title="Two more")
    shown = render(replace(bundle, illustrations=(ILLUSTRATION, other)))
    ids = re.findall(r'\bid="([^"]+)"', shown)
    assert len(ids) == len(set(ids))


def test_a_task_that_the_bundle_lacks_is_refused(bundle):
    with pytest.raises(ValueError, match=r"expected tasks .* got 'unheard-of'"):
        replace(bundle, illustrations=(replace(ILLUSTRATION, task="unheard-of"),))


def test_a_curve_needs_as_many_x_as_y():
    with pytest.raises(ValueError, match="as many x as y"):
        Curve(X, X[:3], "walk")


def test_a_band_is_an_area_in_the_colour_of_its_group():
    band = Band(X, X - 1.0, X + 1.0, "run")
    panel = Panel("", "", "", (WALK, RUN), bands=(band,))
    drawn = draw(replace(ILLUSTRATION, panels=(panel,)))
    areas = re.findall(r'style="fill: var\((--series-\d)\)', drawn.svg)
    assert "--series-1" in areas
    assert "fill-opacity: 0.2" in drawn.svg
