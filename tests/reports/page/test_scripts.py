"""Scripts of figures in a real browser: models light up, matrices and spaces are drawn."""

from importlib.resources import files

import numpy as np
import pytest

from mocapbench.reports import Axes, Curve, HeatMaps, Illustration, Space
from mocapbench.reports.figures.pictures.draw import draw
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.resources import styles

STYLES = {
    name: DrawingStyle(f"h{place}", place, name) for place, name in enumerate(("knn", 'a "b" \\'))
}
TIMES = np.linspace(0.0, 1.0, 5)
CURVES = tuple(Curve(TIMES, TIMES * place, name) for place, name in enumerate(STYLES))
PANELS = Illustration("t", "Curves", "", (Axes("p", "s", "cm", CURVES),))
SIGNS = np.where(np.eye(10) == 1.0, 1.0, -1.0)
MATRIX = HeatMaps("t", "Matrix", "", ("joint",) * 10, {"m": SIGNS}, 1.0, 1)
CLOUD = np.random.default_rng(0).normal(size=(100, 3))
PATHS = (("knn", CLOUD[:9]),)
SPACE = Space("t", "Space", "", PATHS, CLOUD, np.arange(100.0), "confidence")

OPACITIES = """
marks => Object.fromEntries(marks.map(m => [m.dataset.model, getComputedStyle(m).opacity]))
"""
PIXELS = """
canvas => {
  const context = canvas.getContext("2d"), side = canvas.width / 10;
  const at = (row, column) =>
    [...context.getImageData((column + .5) * side, (row + .5) * side, 1, 1).data].join();
  return [at(0, 0), at(5, 5), canvas.width];
}
"""
INK = "c => c.getContext('2d').getImageData(0, 0, c.width, c.height).data.filter(Boolean).length"


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    folder = files("mocapbench.reports.page") / "scripts"
    scripts = [
        (folder / name).read_text(encoding="utf-8") for name in ("highlight.js", "canvas.js")
    ]
    figures = [draw(picture, STYLES) for picture in (PANELS, MATRIX, SPACE)]
    legend = "".join(
        f"<li data-model='{model}'>{swatch}{label}</li>"
        for label, swatch, model in figures[0].legend
    )
    body = f"<ul class=legend>{legend}</ul>" + "".join(each.svg for each in figures)
    page = (
        f"<!DOCTYPE html><head><style>{styles()}</style></head><body><figure>{body}</figure>"
        + "".join(f"<script>{{{script}}}</script>" for script in scripts)
    )
    path = tmp_path_factory.mktemp("page") / "figures.html"
    path.write_text(page, encoding="utf-8")
    return path.as_uri()


@pytest.fixture
def tab(browser, address, until):
    tab = browser.new_page(viewport={"width": 1000, "height": 2000}, color_scheme="light")
    complaints = []
    tab.on("pageerror", lambda error: complaints.append(str(error)))
    tab.goto(address)
    until(tab, "document.querySelector('canvas.matrix').width !== 300")
    yield tab
    assert complaints == []
    tab.close()


def _opacities(tab):
    return tab.eval_on_selector_all("g[data-model]", OPACITIES)


def test_pointing_at_a_model_dims_the_others_and_escape_clears(tab):
    assert set(_opacities(tab).values()) == {"1"}
    tab.locator(".legend li").nth(1).hover()
    dimmed = _opacities(tab)
    assert dimmed['a "b" \\'] == "1"
    assert float(dimmed["knn"]) < 0.5
    tab.keyboard.press("Escape")
    assert set(_opacities(tab).values()) == {"1"}


def test_the_keyboard_reaches_every_key_of_a_legend(tab):
    tab.keyboard.press("Tab")
    assert float(_opacities(tab)['a "b" \\']) < 0.5
    tab.keyboard.press("ArrowRight")
    assert tab.evaluate("document.activeElement.dataset.model") == 'a "b" \\'
    assert float(_opacities(tab)["knn"]) < 0.5


def test_a_matrix_is_coloured_by_its_signs_and_again_in_the_dark(tab):
    matrix = tab.locator("canvas.matrix")
    positive, _, width = matrix.evaluate(PIXELS)
    assert width >= 10 * 3
    assert positive == "238,146,79,255"  # --level-8 of the light theme
    tab.emulate_media(color_scheme="dark")
    tab.wait_for_timeout(200)
    assert matrix.evaluate(PIXELS)[0] == "156,80,21,255"


def test_a_space_is_drawn_and_turns_by_keyboard(tab):
    space = tab.locator("canvas.space")
    space.scroll_into_view_if_needed()
    tab.wait_for_timeout(300)
    before = space.evaluate("c => c.toDataURL()")
    assert space.evaluate(INK) > 0
    space.focus()
    tab.keyboard.press("ArrowLeft")
    assert space.evaluate("c => c.toDataURL()") != before
