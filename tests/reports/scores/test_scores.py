"""Tables of scores: a row a model, best first, and a column a case."""

import math
import re

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.analysis.standings import Place, standings
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.scores.strips import draw_strips
from mocapbench.reports.figures.strip import strip_scale
from mocapbench.reports.figures.styles import model_styles
from mocapbench.reports.paper.published import published_values
from mocapbench.reports.scores.table import (
    _published_mean_cell,
    behind_cell,
    describe_basis,
    score_table,
)
from mocapbench.reports.tables.base import ABSENT
from mocapbench.reports.text import cell_anchor

NAN = float("nan")
laws = settings(max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture])
TWO = {"one": {"a": [1.0, 3.0], "b": [5.0, 5.0]}, "two": {"a": [4.0, 4.0], "b": [2.0, 2.0]}}


def results_of(bundle, task=0):
    return task_results(bundle, bundle.layouts[task])


def table_of(bundle, metric="mse", task=0):
    return score_table(results_of(bundle, task), metric, model_styles(bundle.layouts))


def row(table, label):
    return next(row for row in table["rows"] if row.label == label)


def cell(table, case, label):
    return row(table, label).cells[[name for name, _ in table["heads"]].index(case)]


@pytest.mark.parametrize("task", [0, 1, 2])
def test_every_row_is_as_wide_as_the_heads_and_means_ascend(bundle, task):
    metric = bundle.layouts[task].page.metrics[0]
    table = table_of(bundle, metric, task)
    assert {len(row.cells) for row in table["rows"]} == {len(table["heads"])}
    means = [row.mean.value for row in table["rows"] if row.kind == "ranked"]
    complete = [s for s in standings(results_of(bundle, task), metric) if s.complete]
    assert means[: len(complete)] == sorted(means[: len(complete)])
    kinds = [row.kind for row in table["rows"]]
    assert kinds == sorted(kinds, key=["ranked", "reference", "published"].index)


@laws
@given(st.integers(0, 10_000))
def test_a_mean_is_that_of_the_cases_and_one_alone_is_bold(small, seed):
    numbers = np.random.default_rng(seed).uniform(1.0, 9.0, (3, 2, 4))
    values = {
        f"case {c}": dict(zip("ab", of_case.tolist(), strict=True))
        for c, of_case in enumerate(numbers)
    }
    table = table_of(small(values))
    for place, label in enumerate("ab"):
        assert row(table, label).mean.value == pytest.approx(numbers[:, place].mean())
        for case, of_case in enumerate(numbers):
            found = cell(table, f"case {case}", label).value
            assert found == pytest.approx(of_case[place].mean())
    for column in zip(*([r.mean, *r.cells] for r in table["rows"]), strict=True):
        (best,) = (found for found in column if found.kind == "best")
        assert best.value == min(found.value for found in column)


def test_higher_is_better_where_the_metric_says_so(small):
    table = table_of(small(TWO, metric="mcc"), "mcc")
    assert [row.label for row in table["rows"]] == ["b", "a"]
    assert (table["better"], row(table, "b").mean.kind) == ("higher", "best")
    assert row(table, "a").behind.text == "+0.50"


def test_one_case_has_no_column_beside_its_mean(small):
    table = table_of(small({"row": {"a": [1.0], "b": [2.0]}}))
    assert (table["heads"], table["mean_head"]) == ((), ("row", ()))
    assert row(table, "a").mean.link == cell_anchor("small", "row", "a")


def test_a_mean_over_cases_links_to_the_model_and_a_score_to_its_cell(small):
    table = table_of(small(TWO))
    assert row(table, "a").mean.link == cell_anchor("small", "", "a")
    assert cell(table, "two", "a").link == cell_anchor("small", "two", "a")


def test_heads_name_what_a_case_varies_and_what_its_name_does_not_say(small):
    cases = (
        CaseLayout("one", {"noise": 0.1, "size": "one"}),
        CaseLayout("two", {}, synthetic=True),
    )
    first, second = table_of(small(TWO, cases=cases))["heads"]
    assert first == ("one", ("noise 0.1",))
    assert second == ("two", ("generated",))


def test_generated_cases_beside_recordings_have_columns_and_enter_no_mean(small):
    cases = (CaseLayout("one", {}), CaseLayout("two", {}, synthetic=True))
    table = table_of(small(TWO, cases=cases))
    assert [name for name, _ in table["heads"]] == ["one", "two"]
    assert row(table, "a").mean.value == 2.0
    assert table["mean_head"] == ("mean of 1 case", ())


def test_a_failed_cell_names_the_failure_and_leads_to_its_cell(bundle):
    found = cell(table_of(bundle), "test 8", "nn")
    assert (found.text, found.kind, found.value) == ("failed", "failure", None)
    assert found.link == cell_anchor("toy-interpolation-1", "test 8", "nn")


def test_lost_folds_and_lacking_cases_are_counted(small):
    values = {"one": {"a": [1.0, NAN, 2.0], "b": [5.0] * 3}, "two": {"a": [NAN], "b": [5.0]}}
    table = table_of(small(values))
    assert (cell(table, "one", "a").text, cell(table, "one", "a").note) == ("1.50", "1 fold lost")
    assert row(table, "a").mean.note == "1 of 2 cases"
    assert row(table, "a").behind is ABSENT


def test_a_fold_that_another_metric_failed_is_not_lost(small):
    bundle = small(TWO)
    bundle.records.loc[bundle.records["label"] == "a", "status"] = "failed"
    found = cell(table_of(bundle), "one", "a")
    assert (found.text, found.note) == ("2.00", "")
    assert len(results_of(bundle).failures["one", "a"]) == 2


def test_missing_recordings_are_told_in_the_head_alone(bundle):
    table = table_of(bundle, "rms_per_frame", task=2)
    assert "recording missing" in dict(table["heads"])["12-02 four-walkers"]
    assert cell(table, "12-02 four-walkers", "knn") is ABSENT


@pytest.mark.parametrize("place", Place)
def test_the_lag_says_what_the_test_found(small, place):
    values = {
        Place.INSEPARABLE: [1.3, 0.9, 1.2, 1.1, 1.0, 0.8],
        Place.BEHIND: [9.0, 9.1, 9.2, 9.0, 9.1, 8.9],
        Place.UNTESTED: [9.0],
        Place.INCOMPLETE: [9.0, NAN, 9.0, 9.0, 9.0, 9.0],
    }.get(place, [5.0] * 6)
    best = [1.0, 1.1, 0.9, 1.2, 0.8, 1.0][: len(values)]
    first, second = standings(results_of(small({"row": {"a": best, "b": values}})), "mse")
    found = behind_cell(first if place is Place.BEST else second, 2)
    match place:
        case Place.BEST:
            assert found.text == ""
        case Place.INCOMPLETE:
            assert found is ABSENT
        case Place.UNTESTED:
            assert (found.text, found.note) == ("+8.00", "")
        case Place.INSEPARABLE:
            assert (found.text[:3], found.kind) == ("≈ +", "tied")
            assert second.low <= 0.0 <= second.high
        case Place.BEHIND:
            low, high = map(float, found.note.split(" to "))
            assert (found.text[0], found.kind) == ("+", "")
            assert 0.0 < low < found.value < high


@pytest.mark.parametrize(
    ("independent", "subject", "n_units"), [(True, "", 4), (False, "", 2), (True, "07", 1)]
)
def test_strips_show_every_value_and_an_interval_over_units(small, independent, subject, n_units):
    subjects = (subject,) if subject else ()
    cases = tuple(CaseLayout(name, {}, subjects=subjects) for name in TWO)
    bundle = small(TWO, independent_folds=independent, cases=cases)
    styles = model_styles(bundle.layouts)
    results = results_of(bundle)
    strips, _ = draw_strips(results, "mse", results.cases, styles)
    scale = strip_scale([1.0, 5.0])
    values = {"a": [1.0, 3.0, 4.0, 4.0], "b": [5.0, 5.0, 2.0, 2.0]}
    for label, of_label in values.items():
        places = re.findall(r"M([\d.]+)", re.search(r'class="fold" d="([^"]*)"', strips[label])[1])
        assert [*map(float, places)] == pytest.approx(scale.places(of_label).tolist(), abs=0.051)
    assert ('class="interval"' in strips["a"]) == (n_units > 1)
    assert 'aria-label="a, 4 values"' in strips["a"]
    assert set(strips) == {"a", "b"}


def test_a_metric_without_scores_draws_nothing(small):
    bundle = small(TWO)
    results = results_of(bundle)
    assert draw_strips(results, "mlc", results.cases, model_styles(bundle.layouts)) == ({}, None)


@pytest.mark.parametrize(
    ("lost", "words"),
    [(0, "2 cases, 2 folds each"), (3, "2 cases, 2 folds each, up to 3 outputs left out")],
)
def test_the_basis_counts_cases_folds_and_outputs_left_out(small, lost, words):
    bundle = small(TWO)
    bundle.scores["left_out"] = lost
    results = results_of(bundle)
    assert describe_basis(results, "mse", results.cases).startswith(words)


def test_the_papers_other_models_come_last_with_their_printed_values(bundle):
    table = table_of(bundle, "rms_per_frame", task=2)
    others = [row for row in table["rows"] if row.kind == "published"]
    models = ("GPDM-MAP", "B-GPDM", "GPDM-fixed-alpha", "GPDM-two-stage-MAP")
    assert [row.label for row in others] == [f"{model} (published)" for model in models]
    printed, rows = published_values("missing-frames"), bundle.layouts[2].page.published_rows
    for row_, model in zip(others, models, strict=True):
        for (case_name, _), found in zip(table["heads"], row_.cells, strict=True):
            assert found.value == printed[rows[case_name], "RMS per frame", model].value


def test_a_paper_that_lacks_a_case_has_no_mean(small):
    bundle = small(
        {"one": {"a": [8.0]}, "two": {"a": [9.0]}},
        task="toy-synthesis",
        published_rows={"one": "test 1"},
        published_metrics={"mse": "MCC"},
        published_models={"a": "MOHGP"},
    )
    rows = [row for row in table_of(bundle)["rows"] if row.kind == "published"]
    assert rows
    assert {row.mean for row in rows} == {ABSENT}
    assert all(math.isfinite(row.cells[0].value) for row in rows)


ACTIONS = sorted(
    {value.case for value in published_values("motion-prediction").values()}
    - {"mean", "mean without running", "mean (over which actions is not said)"}
)


def published_means(small, actions):
    """Return the mean of each model of the papers, and the note below it, of a run of some rows."""
    bundle = small(
        {action: {"a": [80.0]} for action in actions},
        task="motion-prediction",
        published_rows={action: action for action in ACTIONS},
        published_metrics={"mse": "MPJPE at 1000 ms"},
        published_mean="mean",
    )
    rows = [row for row in table_of(bundle)["rows"] if row.kind == "published"]
    return {row.label.removesuffix(" (published)"): (row.mean.value, row.mean.note) for row in rows}


def test_the_mean_of_a_paper_is_the_printed_one_where_all_its_cases_are_run(small):
    means = published_means(small, ACTIONS)
    assert means["MSR-GCN (Dang 2021)"] == (78.63, "")
    assert means["PGBIG (Ma 2022, supplement)"][0] is None  # it lacks running


def test_the_printed_mean_of_other_cases_stands_beside_no_run_of_some(small):
    means = published_means(small, ACTIONS[:2])
    assert means["MSR-GCN (Dang 2021)"][0] == pytest.approx((86.96 + 47.91) / 2)


def test_a_printed_mean_that_is_not_that_of_its_cases_says_so():
    assert _published_mean_cell(76.7, 80.2, 1).note == "80.2 by its cases"
    assert _published_mean_cell(76.7, 76.74, 1).note == ""
