import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis.extra.numpy import arrays

from mocapbench.reports import HeatMap, HeatMaps, render
from mocapbench.reports.figures.cells import levels_of, rectangles
from mocapbench.reports.figures.draw import draw

SMALL = HeatMaps(
    task="toy-interpolation-1",
    title="Three outputs",
    caption="what <b>is</b> seen.",
    labels=("hip", "hip", "knee"),
    maps=(
        HeatMap("parent", np.array([[1.0, -0.5, 0.0], [-0.5, 0.25, -0.001], [0.0, -0.001, 2.0]])),
        HeatMap("child", np.eye(3)),
    ),
    limit=1.0,
    columns=1,
)
LARGE = replace(SMALL, labels=("hip",) * 12, maps=(HeatMap("parent", 1.0 - 2.0 * np.eye(12)),))


@pytest.fixture(scope="module")
def small():
    return draw(SMALL)


def test_levels_are_nine_of_equal_width_and_what_lies_beyond_is_in_the_outermost():
    edges = np.linspace(-2.0, 2.0, 10)
    centres = (edges[1:] + edges[:-1]) / 2
    np.testing.assert_array_equal(levels_of(centres, 2.0), np.arange(9))
    np.testing.assert_array_equal(
        levels_of(np.array([-7.0, -2.0, 0.0, 2.0, 7.0]), 2.0), [0, 0, 4, 8, 8]
    )


@given(chosen=arrays(bool, (4, 6)))
def test_the_rectangles_are_the_chosen_cells(chosen):
    path, drawn = rectangles(chosen), np.zeros((4, 6), dtype=int)
    for (left, top), _, (right, bottom), *_ in path.vertices.reshape(-1, 5, 2).astype(int):
        drawn[top:bottom, left:right] += 1
    np.testing.assert_array_equal(drawn, chosen)


def test_it_is_xml_with_a_name_and_names_its_maps_rows_and_columns(small):
    root = ElementTree.fromstring(small.svg)
    assert root.attrib["role"] == "img"
    assert root.attrib["aria-label"] == "Three outputs: 2 heat maps"
    texts = [text for text in root.itertext() if text.strip()]
    assert {"parent", "child"} <= set(texts)
    # Rows of both maps, and the columns of the lower one, which the upper one shares.
    assert texts.count("hip") == texts.count("knee") == 3


def test_every_column_of_maps_has_its_names_where_the_last_row_is_short():
    lone = draw(replace(SMALL, maps=(*SMALL.maps, *SMALL.maps[:1]), columns=2))
    # Two rows of maps have names on the left, and two columns below.
    assert "".join(ElementTree.fromstring(lone.svg).itertext()).count("knee") == 4


def test_small_matrices_are_written_out_and_large_ones_hatched_where_negative(small):
    values = re.findall(r">(−?\d\.\d\d)<", small.svg)
    assert values[:9] == ["1.00", "−0.50", "0.00", "−0.50", "0.25", "0.00", "0.00", "0.00", "2.00"]
    assert "<pattern" not in small.svg
    large = draw(LARGE)
    assert re.findall(r">(−?\d\.\d\d)<", large.svg) == []
    assert "<pattern" in large.svg
    assert ["<pattern" in key.swatch for key in large.legend] == [True] * 4 + [False] * 5


def test_the_legend_names_each_level(small):
    assert [key.label for key in small.legend] == [
        *("≤ −0.78", "−0.67", "−0.44", "−0.22", "0"),
        *("0.22", "0.44", "0.67", "≥ 0.78"),
    ]


def test_colours_are_left_to_the_page(small):
    assert "var(--level-8)" in small.svg
    assert not re.findall(r"(?:fill|stroke): #[0-9a-f]+", small.svg + draw(LARGE).svg)


def test_the_same_heat_maps_give_the_same_bytes(small):
    assert draw(SMALL) == small


def test_a_page_shows_them_with_ids_that_stay_unique(bundle):
    shown = render(replace(bundle, illustrations=(SMALL, replace(LARGE, title="Other"))))
    section = shown[shown.index('<h2 id="task-toy-interpolation-1"') :]
    assert "Three outputs" in section[: section.index("<h2", 10)]
    assert "what &lt;b&gt;is&lt;/b&gt; seen." in shown
    ids = re.findall(r'\bid="([^"]+)"', shown)
    assert len(ids) == len(set(ids))


def test_the_page_has_a_colour_for_each_level_by_day_and_by_night(page):
    assert [page.count(f"--level-{level}: #") for level in range(9)] == [2] * 9


def test_invalid_heat_maps_are_refused():
    with pytest.raises(ValueError, match=r"3 rows and columns, as many as labels, got .*\(2, 2\)"):
        replace(SMALL, maps=(HeatMap("", np.eye(2)),))
    with pytest.raises(ValueError, match=r"got shapes \[\]"):
        replace(SMALL, maps=())
    with pytest.raises(ValueError, match="positive limit, got 0"):
        replace(SMALL, limit=0.0)
    with pytest.raises(TypeError, match="got str"):
        draw("a figure")
