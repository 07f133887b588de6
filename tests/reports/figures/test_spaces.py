import re

import numpy as np
import pytest

from mocapbench.reports.bundle.pictures import Path3D, Space
from mocapbench.reports.figures.draw import draw

ANGLE = np.linspace(0.0, 6.0, 20)
SPIRAL = np.column_stack([np.cos(ANGLE), np.sin(ANGLE), ANGLE])
RNG = np.random.default_rng(0)
CLOUD = RNG.normal(size=(200, 3))


def space(values):
    paths = (Path3D(SPIRAL, "training"), Path3D(SPIRAL + 1.0, "training"), Path3D(SPIRAL, "mean"))
    return Space("filling", "Latent space", "caption", paths, CLOUD, values, "confidence")


def test_a_space_is_drawn_from_two_sides_with_a_key_for_each_group_and_level():
    drawing = draw(space(np.arange(200.0)))
    texts = [str(key.label) for key in drawing.legend]
    assert texts[:2] == ["training", "mean"]
    assert [text.startswith("confidence ≥ 1") for text in texts[2:]] == [True] * 4
    assert "3 paths, from two sides" in drawing.svg


def test_only_the_highest_tenth_of_the_cloud_is_shown():
    marks = re.findall(r"<use ", draw(space(np.arange(200.0))).svg)
    assert len(marks) >= 2 * 20
    fewer = re.findall(r"<use ", draw(space(np.zeros(200))).svg)
    assert len(fewer) > len(marks)  # ties are all highest


def test_the_same_space_gives_the_same_bytes():
    assert draw(space(np.arange(200.0))).svg == draw(space(np.arange(200.0))).svg


def test_a_cloud_needs_a_value_for_each_point():
    with pytest.raises(ValueError, match=r"expected a cloud of shape \(3, 3\)"):
        space(np.zeros(3))
