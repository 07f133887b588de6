"""Each model has one style through the whole page, and colours that colour-blind readers tell."""

import re
from importlib.resources import files
from itertools import pairwise

import numpy as np
import pytest
from colorspacious import cspace_convert, deltaE

from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.bundle.task_page import TaskPage
from mocapbench.reports.figures.styles import N_HUES, model_styles

COLOURS = (files("mocapbench.reports.page") / "styles" / "colours.css").read_text(encoding="utf-8")
THEMES = dict(zip(("light", "dark"), COLOURS.split("@media", 1), strict=True))
# Machado, Oliveira and Fernandes (2009), at full severity.
SIGHTS = ("protanomaly", "deuteranomaly", "tritanomaly")
HUES = [f"series-{place}" for place in range(N_HUES)]


def _colour(theme, name):
    value = re.search(rf"--{name}: #([0-9a-f]{{6}})", THEMES[theme]).group(1)
    return np.array([int(value[i : i + 2], 16) / 255 for i in (0, 2, 4)])


def _seen(colour, sight):
    if sight == "normal":
        return colour
    space = {"name": "sRGB1+CVD", "cvd_type": sight, "severity": 100}
    return np.clip(cspace_convert(colour, space, "sRGB1"), 0.0, 1.0)


@pytest.mark.parametrize("sight", ["normal", *SIGHTS])
@pytest.mark.parametrize("theme", THEMES)
def test_hues_differ_for_every_sight(theme, sight):
    names = [*HUES, "series-reference", "ink"]
    seen = [_seen(_colour(theme, name), sight) for name in names]
    apart = {
        (names[i], names[j]): deltaE(seen[i], seen[j], input_space="sRGB1")  # CAM02-UCS
        for i in range(len(seen))
        for j in range(i)
    }
    assert {pair: d for pair, d in apart.items() if d <= 10.0} == {}


@pytest.mark.parametrize("name", [*HUES, "series-reference", "ink", "quiet"])
@pytest.mark.parametrize("theme", THEMES)
def test_marks_stand_out_from_the_paper(theme, name):
    lighter, darker = sorted(
        (_luminance(_colour(theme, each)) for each in (name, "paper")), reverse=True
    )
    assert (lighter + 0.05) / (darker + 0.05) >= 3.0


def _luminance(colour):
    """Return the relative luminance by WCAG 2."""
    linear = np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)
    return linear @ [0.2126, 0.7152, 0.0722]


def _layout(name, labels):
    return TaskLayout(
        name, TaskPage(title="", reference="", description="", metrics=()), (), labels
    )


MANY = tuple(f"model-{place}" for place in range(60))


def test_sixty_models_have_styles_of_their_own():
    layouts = [_layout(str(i), MANY[i : i + 12]) for i in range(0, 60, 7)]
    styles = model_styles(layouts)
    assert len({style.classes for style in styles.values()}) == len(styles) == 60


def test_the_models_of_a_small_table_differ_in_hue():
    layouts = [_layout(str(i), MANY[i : i + 6]) for i in range(0, 54, 6)]
    styles = model_styles(layouts)
    for layout in layouts:
        assert all(styles[a].hue != styles[b].hue for a, b in pairwise(layout.labels))


def test_references_are_grey_and_no_model_is():
    styles = model_styles([_layout("a", ("knn", "oracle", "trivial", "replay", "control"))])
    assert {name for name, style in styles.items() if style.hue == "hr"} == {
        *("oracle", "trivial", "replay", "control")
    }
    assert len({style.shape for style in styles.values() if style.hue == "hr"}) == 4
