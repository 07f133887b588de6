import re
from xml.etree import ElementTree

import numpy as np
import pandas as pd
import pytest
from scipy import stats

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.error_bars import error_bars
from mocapbench.reports.figures.point_axes import t_interval


@pytest.fixture(scope="module")
def results(bundle):
    return task_results(bundle, bundle.layouts[0])


@pytest.fixture(scope="module")
def figure(results):
    return error_bars(results, "mse").svg


def test_the_interval_is_that_of_students_t():
    values = pd.Series([1.0, 2.0, 4.0, 3.5, 0.5])
    expected = stats.ttest_1samp(values, 0.0).confidence_interval(0.95)
    assert t_interval(values) == pytest.approx((expected.low, expected.high))


def test_one_value_has_no_interval():
    assert t_interval(pd.Series([2.0])) == (2.0, 2.0)


def test_the_interval_covers_as_it_claims():
    rng = np.random.default_rng(0)
    bounds = [t_interval(pd.Series(rng.standard_normal(5))) for _ in range(2000)]
    covered = np.mean([low < 0.0 < high for low, high in bounds])
    assert covered == pytest.approx(0.95, abs=0.02)


def test_it_is_xml_with_a_name(figure):
    root = ElementTree.fromstring(figure)
    assert root.attrib["role"] == "img"
    assert root.attrib["aria-label"] == "MSE of 9 entrants in 9 cases"


def test_ids_are_unique_and_references_resolve(figure):
    ids = re.findall(r'\bid="([^"]+)"', figure)
    assert len(ids) == len(set(ids))
    assert set(re.findall(r'(?:href="|url\()#([^")]+)', figure)) <= set(ids)


def test_two_figures_share_no_id(results, figure):
    bars = [error_bars(results, metric) for metric in ("mse", "smse_pooled")]
    drawings = [svg for each in bars for svg in (each.svg, *(key.swatch for key in each.legend))]
    ids = [name for svg in drawings for name in set(re.findall(r'\bid="([^"]+)"', svg))]
    assert len(ids) == len(set(ids))


def test_colours_are_left_to_the_page(figure):
    assert "var(--series-0)" in figure
    assert "var(--ink)" in figure
    assert not re.findall(r"(?:fill|stroke): #[0-9a-f]+", figure)


def test_an_entrant_looks_the_same_in_every_figure(results):
    looks = [_looks(error_bars(results, metric)) for metric in ("mse", "msll")]
    shared = looks[0].keys() & looks[1].keys()
    assert "trivial" in shared
    assert all(looks[0][label] == looks[1][label] for label in shared)


def _looks(bars):
    """Return the styles of the line and the marker in the swatch of each label."""
    return {key.label: re.findall(r'style="([^"]*stroke[^"]*)"', key.swatch) for key in bars.legend}


def test_a_swatch_looks_like_its_series(results):
    bars = error_bars(results, "mse")
    for styles in _looks(bars).values():
        assert styles
        assert all(f'style="{style}"' in bars.svg for style in styles)


def test_markers_tell_entrants_apart_without_colour(results):
    shapes = {
        re.search(r'<path id="[^"]*" d="([^"]*)"', key.swatch).group(1)
        for key in error_bars(results, "mse").legend
    }
    assert len(shapes) == 9


def test_the_same_results_give_the_same_bytes(results, figure):
    assert error_bars(results, "mse").svg == figure
    assert "<metadata>" not in figure


def test_names_are_text_whatever_they_hold(small):
    label = "<b>$x_1$ & $y$</b>"
    bundle = small({label: {label: [1.0, 2.0]}})
    bars = error_bars(task_results(bundle, bundle.layouts[0]), "mse")
    assert [key.label for key in bars.legend] == [label]
    assert label in "".join(ElementTree.fromstring(bars.svg).itertext())


@pytest.mark.parametrize(("independent", "taller"), [(True, True), (False, False)])
def test_only_independent_folds_have_intervals(small, independent, taller):
    """A thousand times the spread around the same mean shows only where it is an interval."""
    narrow, wide = (
        small({"row": {"a": [5.0 - s, 5.0 + s]}}, independent_folds=independent)
        for s in (0.001, 1.0)
    )
    bars = [error_bars(task_results(each, each.layouts[0]), "mse") for each in (narrow, wide)]
    assert (bars[0].svg != bars[1].svg) is taller
    assert all(("not independent" in each.caption) is not independent for each in bars)


def test_no_line_leads_from_recordings_to_generated_motion(small):
    cases = tuple(CaseLayout(name, {}, synthetic=name == "made") for name in ("real", "made"))
    values = {case.name: {"a": [1.0, 2.0], "b": [2.0, 3.0]} for case in cases}
    apart, joined = (
        error_bars(task_results(each, each.layouts[0]), "mse").svg
        for each in (small(values, cases=cases), small(values))
    )
    assert apart.count('id="small-mse-figure-axes_') == 2
    assert joined.count('id="small-mse-figure-axes_') == 1
    assert "made (synthetic)" in "".join(ElementTree.fromstring(apart).itertext())


def test_every_entrant_with_a_score_has_a_key(bundle, results):
    keys = [key.label for key in error_bars(results, "mse").legend]
    assert keys == list(bundle.layouts[0].labels)


def test_no_scores_no_figure(small):
    bundle = small({"row": {"a": [float("nan")]}})
    assert error_bars(task_results(bundle, bundle.layouts[0]), "mse") is None
