import re

import pytest

from mocapbench.metrics.statistics import FEWEST_UNITS, mean_ranks, nemenyi
from mocapbench.reports.analysis.ranks import ranks_over_units
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.scores.ranks import rank_figure
from mocapbench.reports.figures.styles import DrawingStyle

STYLES = {label: DrawingStyle("h0", 0, label) for label in "abcd"}
ORDERED = {
    f"row {number}": {"a": [1.0 * number], "b": [2.0 * number], "c": [3.0 * number]}
    for number in range(1, 9)
}


def results_of(bundle):
    return task_results(bundle, bundle.layouts[0])


def test_ranks_run_over_units(small):
    ranks = ranks_over_units(results_of(small(ORDERED)), "mse")
    assert (list(ranks), ranks.index.name) == (["a", "b", "c"], "fold")
    assert mean_ranks(ranks) == (1.0, 2.0, 3.0)
    assert len(ranks) == 8


def test_ranks_follow_the_direction(small):
    values = {case: {"a": [0.1], "b": [0.5], "c": [0.8]} for case in "stuvwxyz"}
    ranks = ranks_over_units(results_of(small(values, metric="coverage_50")), "coverage_50")
    assert mean_ranks(ranks) == (3.0, 1.0, 2.0)


def test_an_entrant_without_a_score_in_every_case_is_left_out_and_named(small):
    values = {**ORDERED, "row 1": {**ORDERED["row 1"], "d": [0.5]}}
    ranks = ranks_over_units(results_of(small(values)), "mse")
    assert list(ranks.columns[ranks.notna().all()]) == ["a", "b", "c"]
    assert ranks["d"].isna().all()
    assert "Left out, without every score: d." in rank_figure(ranks, "t", STYLES).caption


@pytest.mark.parametrize(
    "values",
    [
        {"row": ORDERED["row 1"]},
        {case: {"a": [1.0], "b": [2.0]} for case in ORDERED},
        {case: {"a": [1.0], "b": [2.0], "oracle": [0.1]} for case in ORDERED},
        {case: {"a": [float("nan")]} for case in ORDERED},
    ],
)
def test_too_little_to_rank_gives_no_diagram(small, values):
    assert ranks_over_units(results_of(small(values)), "mse") is None


def test_ranks_run_over_subjects_where_cases_have_one(small):
    cases = tuple(CaseLayout(name, {}, subjects=(name[-1:],)) for name in (*ORDERED, "again 1"))
    results = results_of(small({**ORDERED, "again 1": ORDERED["row 1"]}, cases=cases))
    ranks = ranks_over_units(results, "mse")
    assert (len(ranks), ranks.index.name) == (8, "subject")


@pytest.mark.parametrize(("n_cases", "n_labels"), [(4, 3), (5, 9), (5, 12)])
def test_ranks_that_cannot_separate_are_not_drawn(small, n_cases, n_labels):
    """Either too few units, or the critical difference is as wide as the ranks reach."""
    labels = {f"label {n}": [float(n)] for n in range(n_labels)}
    ranks = ranks_over_units(results_of(small(dict.fromkeys("abcde"[:n_cases], labels))), "mse")
    reach = n_labels - 1
    assert (ranks is None) == (n_cases < FEWEST_UNITS or nemenyi(n_cases, n_labels) >= reach)


def test_the_diagram_names_its_groups_in_words(small):
    drawing = rank_figure(ranks_over_units(results_of(small(ORDERED)), "mse"), "MSE", STYLES)
    assert "Not separable, joined by a bar: a, b; b, c." in drawing.caption
    assert 'aria-label="MSE: mean ranks of 3 entrants over 8 folds"' in drawing.svg
    names = re.findall(r">([abc])</text>", drawing.svg)
    assert names == ["a", "b", "c"]


def test_the_same_ranks_give_the_same_bytes(small):
    ranks = ranks_over_units(results_of(small(ORDERED)), "mse")
    assert rank_figure(ranks, "MSE", STYLES) == rank_figure(ranks, "MSE", STYLES)
