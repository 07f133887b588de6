"""Curves along a column: which cases share a panel, and what the curves go through."""

import re
from dataclasses import replace
from xml.etree import ElementTree

import pytest

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.figures import panels
from mocapbench.reports.figures.along import curves_along


@pytest.fixture
def along(bundle, monkeypatch):
    """Return a function that draws curves of the first task, its cases given other columns."""

    def along(columns):
        layout = bundle.layouts[0]
        cases = tuple(
            replace(case, columns=own) for case, own in zip(layout.cases, columns, strict=False)
        )
        results = task_results(bundle, replace(layout, cases=cases))
        drawn = []
        draw = panels.draw
        monkeypatch.setattr(panels, "draw", lambda picture: drawn.append(picture) or draw(picture))
        return results, drawn, curves_along(results, "mse", "seconds")

    return along


TWO_PANELS = [{"hidden": place, "seconds": s} for place in ("arm", "leg") for s in (0.5, 1.0)]


def test_cases_alike_in_all_other_columns_share_a_panel(along):
    results, (picture,), figure = along(TWO_PANELS)
    assert [panel.title for panel in picture.panels] == ["arm", "leg"]
    for panel, cases in zip(picture.panels, (results.cases[:2], results.cases[2:]), strict=True):
        for curve in panel.curves:
            assert curve.x.tolist() == [0.5, 1.0]
            means = [results.estimate(case.name, curve.group, "mse").mean for case in cases]
            assert curve.y.tolist() == means
    assert ElementTree.fromstring(figure.svg).attrib["role"] == "img"
    assert {key.label for key in figure.legend} == set(picture.groups)


def test_a_single_number_makes_no_curve(along):
    lengths = [{"hidden": place, "seconds": 0.5} for place in ("arm", "leg", "hand")]
    assert along(lengths)[2] is None


def test_two_figures_share_no_id(bundle, along):
    results, _, one = along(TWO_PANELS)
    two = curves_along(results, "smse_pooled", "seconds")
    ids = [name for each in (one, two) for name in set(re.findall(r'\bid="([^"]+)"', each.svg))]
    assert len(ids) == len(set(ids))
