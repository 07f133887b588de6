import re

import pytest

from mocapbench.reports.analysis.ranks import ranks_over_cases, ranks_over_tasks
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.figures.scores.ranks import rank_figure
from mocapbench.reports.figures.styles import Style

ORDERED = {
    f"row {number}": {"a": [1.0 * number], "b": [2.0 * number], "c": [3.0 * number]}
    for number in range(1, 9)
}

STYLES = {label: Style("h0", 0, label) for label in "abcd"}


def results_of(bundle):
    return task_results(bundle, bundle.layouts[0])


def test_ranks_run_over_the_means_of_cases(small):
    ranks = ranks_over_cases(results_of(small(ORDERED)), "mse")
    assert (ranks.labels, ranks.blocks) == (("a", "b", "c"), "cases")
    assert ranks.comparison.mean_ranks == (1.0, 2.0, 3.0)
    assert ranks.comparison.n == 8


def test_ranks_follow_the_direction(small):
    values = {case: {"a": [0.1], "b": [0.5], "c": [0.8]} for case in ("x", "y")}
    ranks = ranks_over_cases(results_of(small(values, metric="coverage_50")), "coverage_50")
    assert ranks.comparison.mean_ranks == (3.0, 1.0, 2.0)


def test_an_entrant_without_a_score_in_every_case_is_left_out_and_named(small):
    values = {**ORDERED, "row 1": {**ORDERED["row 1"], "d": [0.5]}}
    ranks = ranks_over_cases(results_of(small(values)), "mse")
    assert (ranks.labels, ranks.left_out) == (("a", "b", "c"), ("d",))
    assert "Left out, without a score in every case: d." in rank_figure(ranks, "t", STYLES).caption


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
    assert ranks_over_cases(results_of(small(values)), "mse") is None


def test_a_task_counts_once_however_many_cases_it_has(small):
    many, few = (
        results_of(small(ORDERED)),
        results_of(small({"row": {"c": [1.0], "b": [2.0], "a": [3.0]}})),
    )
    ranks = ranks_over_tasks([many, few])
    assert (ranks.blocks, ranks.comparison.n) == ("tasks", 2)
    assert ranks.comparison.mean_ranks == (2.0, 2.0, 2.0)


def test_only_common_entrants_are_ranked_over_tasks(small):
    other = small({"row": {"a": [1.0], "b": [2.0], "c": [3.0], "d": [0.1]}})
    ranks = ranks_over_tasks([results_of(small(ORDERED)), results_of(other)])
    assert (ranks.labels, ranks.left_out) == (("a", "b", "c"), ("d",))
    strangers = small({"row": {"x": [1.0], "y": [2.0], "z": [3.0]}})
    assert ranks_over_tasks([results_of(small(ORDERED)), results_of(strangers)]) is None
    assert ranks_over_tasks([results_of(small(ORDERED))]) is None


def test_the_diagram_names_its_groups_in_words(small):
    drawing = rank_figure(ranks_over_cases(results_of(small(ORDERED)), "mse"), "MSE", STYLES)
    assert "Not separable, joined by a bar: a, b; b, c." in drawing.caption
    assert 'aria-label="MSE: mean ranks of 3 entrants over 8 cases"' in drawing.svg
    names = re.findall(r">([abc])</text>", drawing.svg)
    assert names == ["a", "b", "c"]


def test_the_same_ranks_give_the_same_bytes(small):
    ranks = ranks_over_cases(results_of(small(ORDERED)), "mse")
    assert rank_figure(ranks, "MSE", STYLES) == rank_figure(ranks, "MSE", STYLES)
