"""Pictures of tasks: what is drawn, in which style, and under which name."""

import re
from base64 import b64decode
from dataclasses import replace
from html import unescape
from json import loads
from xml.etree import ElementTree

import numpy as np
import pytest

from mocapbench.reports import Axes, Curve, HeatMaps, Illustration, Space
from mocapbench.reports.figures.pictures.draw import draw
from mocapbench.reports.figures.pictures.heat_maps import levels_of
from mocapbench.reports.figures.pictures.spaces import projection
from mocapbench.reports.figures.styles import DrawingStyle

MODELS = {"knn": DrawingStyle("h4", 2, "knn")}
TIMES = np.linspace(0.0, 12.0, 100)
CURVES = tuple(
    Curve(TIMES, np.sin(TIMES + shift), name)
    for shift, name in enumerate(("truth", "knn", "<other>"))
)
AREA = np.column_stack([TIMES, TIMES, TIMES + 1.0])
PICTURE = Illustration(
    "a task",
    "Filled channels",
    "caption",
    (
        Axes("knee", "time, s", "deg", CURVES, bands={"knn": AREA}),
        Axes("walk", "", "height, cm", CURVES, spatial=True),
    ),
)
MATRICES = HeatMaps(
    task="a task",
    title="Three outputs",
    caption="what is seen",
    labels=("hip", "hip", "knee"),
    maps={
        "parent": np.array([[1.0, -0.5, 0.0], [-0.5, 0.25, -0.001], [0.0, -0.001, 2.0]]),
        "child": np.eye(3),
    },
    limit=1.0,
    columns=1,
)
LARGE = replace(MATRICES, labels=("hip",) * 12, maps={"parent": 1.0 - 2.0 * np.eye(12)})
ANGLE = np.linspace(0.0, 6.0, 20)
SPIRAL = np.column_stack([np.cos(ANGLE), np.sin(ANGLE), ANGLE])
CLOUD = np.random.default_rng(0).normal(size=(200, 3))
PATHS = (("knn", SPIRAL), ("knn", SPIRAL + 1.0), ("truth", SPIRAL))
SPACE = Space("a task", "Latent space", "caption", PATHS, CLOUD, np.arange(200.0), "confidence")
PICTURES = {"curves": PICTURE, "matrices": MATRICES, "large": LARGE, "space": SPACE}


@pytest.fixture(params=PICTURES)
def figure(request):
    return draw(PICTURES[request.param], MODELS)


def test_every_drawing_has_a_name_and_no_id(figure):
    root = ElementTree.fromstring(figure.svg.replace(" hidden ", " "))
    drawings = [each for each in root.iter() if each.tag in {"svg"}]
    assert drawings
    assert all(each.attrib["role"] == "img" and each.attrib["aria-label"] for each in drawings)
    assert " id=" not in figure.svg


def test_colours_are_left_to_the_page(figure):
    assert not re.findall(r"#[0-9a-f]{6}|rgb\(", figure.svg)


def test_the_same_picture_gives_the_same_bytes(figure):
    again = [draw(picture, MODELS).svg for picture in PICTURES.values()]
    assert figure.svg in again


def test_a_group_of_a_model_is_in_its_style_and_the_truth_in_ink():
    figure = draw(PICTURE, MODELS)
    root = ElementTree.fromstring(figure.svg)
    styles = [(g.attrib["class"], g.attrib.get("data-model")) for g in root.iter("g")]
    assert set(styles) == {("ht k0", None), ("h4 k2", "knn"), ("h0 k0", None)}
    assert [(label, model) for label, _, model in figure.legend] == [
        *(("truth", ""), ("knn", "knn"), ("<other>", "")),
    ]


def test_time_is_on_a_linear_axis_however_long():
    texts = set(ElementTree.fromstring(draw(PICTURE, MODELS).svg).itertext())
    assert {"0", "5", "10", "time, s", "deg", "knee", "walk"} <= texts


def test_a_panel_of_many_curves_stays_small():
    rng = np.random.default_rng(0)
    smooth = (np.sin(TIMES * rate) for rate in rng.uniform(0.5, 1.5, 36))
    panel = Axes("", "", "", tuple(Curve(TIMES, y, "knn") for y in smooth))
    assert len(draw(Illustration("t", "t", "", (panel,)), MODELS).svg) < 15_000


def test_levels_are_nine_of_equal_width_and_what_lies_beyond_is_in_the_outermost():
    edges = np.linspace(-2.0, 2.0, 10)
    centres = (edges[1:] + edges[:-1]) / 2
    np.testing.assert_array_equal(levels_of(centres, 2.0), np.arange(9))
    np.testing.assert_array_equal(
        levels_of(np.array([-7.0, -2.0, 0.0, 2.0, 7.0]), 2.0), [0, 0, 4, 8, 8]
    )


def test_small_matrices_are_written_out():
    svg = draw(MATRICES, {}).svg
    values = re.findall(r">(−?\d\.\d\d)<", svg)
    assert values[:9] == ["1.00", "−0.50", "0.00", "−0.50", "0.25", "0.00", "0.00", "0.00", "2.00"]
    assert "<canvas" not in svg
    assert svg.count(">knee</text>") == 4  # beside the rows and below the columns of two maps


def test_large_matrices_are_data_of_a_canvas():
    svg = draw(LARGE, {}).svg
    (cells,) = re.findall(r'data-cells="([^"]+)"', svg)
    values = np.frombuffer(b64decode(cells), dtype=np.int8).reshape(12, 12)
    np.testing.assert_array_equal(values, np.where(np.eye(12) == 1.0, -127, 127))
    assert "12 rows and as many columns, −1 to 1" in svg


def test_a_space_is_drawn_from_two_sides_with_a_key_for_each_group_and_level():
    figure = draw(SPACE, MODELS)
    names = [label for label, _, _ in figure.legend]
    assert names[:2] == ["knn", "truth"]
    assert [name.startswith("confidence ≥ 1") for name in names[2:]] == [True] * 4
    assert figure.svg.count("3 paths, elevation 22°") == 2


def test_the_canvas_holds_the_highest_tenth_of_the_cloud_and_every_path():
    (data,) = re.findall(r'data-space="([^"]+)"', draw(SPACE, MODELS).svg)
    space = loads(unescape(data))
    cloud = np.frombuffer(b64decode(space["cloud"]), dtype="<i2").reshape(-1, 3)
    assert len(cloud) == len(space["levels"]) == 20
    assert set(space["levels"]) == {5, 6, 7, 8}
    assert [(hue, label) for hue, label, _ in space["paths"]] == [
        *(("h4", "knn"), ("h4", "knn"), ("ht", "")),
    ]


def test_a_projection_keeps_lengths_across_the_view():
    onto = projection(22.0, -60.0)
    np.testing.assert_allclose(onto.T @ onto, np.eye(2), atol=1e-12)


def test_what_is_no_picture_is_refused():
    with pytest.raises(TypeError, match="expected an Illustration, HeatMaps or a Space, got int"):
        draw(3, {})
