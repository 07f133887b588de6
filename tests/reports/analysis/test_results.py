import math

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from scipy import stats

from mocapbench.metrics.statistics import mean_interval
from mocapbench.reports.analysis.estimates import FoldMean
from mocapbench.reports.analysis.results import list_failures, task_results
from mocapbench.reports.analysis.standings import standings
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.front.scoreboard import board_cells

values = st.lists(st.floats(-1e3, 1e3), min_size=2, max_size=12)


def test_an_estimate_in_closed_form():
    estimate = FoldMean.of([1.0, 3.0])
    assert (estimate.mean, estimate.n) == (2.0, 2)
    assert estimate.two_sd == pytest.approx(2.0 * math.sqrt(2.0))


@given(values, st.floats(-1e3, 1e3))
def test_a_shift_moves_the_mean_and_leaves_the_spread(sample, shift):
    plain, moved = FoldMean.of(sample), FoldMean.of([value + shift for value in sample])
    assert moved.mean == pytest.approx(plain.mean + shift, abs=1e-8)
    assert moved.two_sd == pytest.approx(plain.two_sd, abs=1e-8)


def test_one_fold_has_no_spread_and_no_interval():
    assert FoldMean.of([0.3]) == FoldMean(0.3, None, 1)
    assert FoldMean.of([0.3]).half_width is None


@given(values)
def test_the_interval_is_that_of_students_t(sample):
    assume(np.std(sample) > 1e-6)
    expected = stats.ttest_1samp(sample, 0.0).confidence_interval(0.95)
    assert 2.0 * FoldMean.of(sample).half_width == pytest.approx(expected.high - expected.low)


def results_of(bundle):
    return task_results(bundle, bundle.layouts[0])


def test_the_ranking_follows_the_direction(small):
    table = {"row": {"a": [1.0], "b": [0.5], "c": [2.0]}}
    assert results_of(small(table)).ranking("row", "mse") == ["b", "a", "c"]
    near = {"row": {"a": [0.2], "b": [0.55], "c": [0.9]}}
    assert results_of(small(near, metric="coverage_50")).ranking("row", "coverage_50")[0] == "b"


def test_an_entrant_that_lacks_a_fold_does_not_lead(small):
    table = {"row": {"a": [1.0, 9.0, 2.0], "fails": [1.1, np.nan, 2.1], "b": [2.0, 9.5, 3.0]}}
    results = results_of(small(table))
    assert results.estimate("row", "fails", "mse").mean < results.estimate("row", "a", "mse").mean
    assert results.ranking("row", "mse") == ["a", "b", "fails"]
    assert results.best_label("row", "mse") == "a"


def test_the_oracle_is_never_ranked(small):
    results = results_of(small({"row": {"a": [1.0], "oracle": [0.1]}}))
    assert results.ranking("row", "mse") == ["a"]
    assert results.best_label("row", "mse") == "a"


def test_one_label_is_best_and_of_equal_means_the_first_in_table_order(small):
    results = results_of(small({"row": {"a": [1.0], "b": [1.0]}}))
    assert results.best_label("row", "mse") == "a"
    assert results.best_label("elsewhere", "mse") is None


def test_scores_that_are_not_finite_do_not_count(small):
    bundle = small({"row": {"a": [1.0, 3.0]}})
    bundle.scores["value"] = [1.0, np.inf]
    assert results_of(bundle).estimate("row", "a", "mse") == FoldMean(1.0, None, 1)


def test_only_cases_with_records_are_shown(small):
    bundle = small({"row": {"a": [1.0]}, "other": {"a": [1.0]}})
    records = bundle.records[bundle.records["case"] == "other"]
    assert [
        case.name
        for case in results_of(
            type(bundle)(bundle.scores, records, bundle.layouts, bundle.metrics, {})
        ).cases
    ] == ["other"]


def test_every_job_without_a_score_is_a_failure(bundle):
    found = list_failures(bundle)
    assert len(found) == (bundle.records["status"] != "ok").sum()
    assert found["id"].is_unique
    assert (found["message"] != "").all()


def test_the_spread_over_samples_is_averaged_over_folds(small):
    bundle = small({"row": {"a": [1.0, 3.0, 2.0]}})
    bundle.scores["sample_two_sd"] = [0.4, 0.6, np.nan]
    found = results_of(bundle).estimate("row", "a", "mse")
    assert found.sample_two_sd == pytest.approx(0.5)
    assert found.two_sd == pytest.approx(2.0)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("lost", [(), (0,), (1, 3), (0, 1, 2), (1, 2, 3)])
def test_an_estimate_is_that_of_the_folds_that_have_a_score(small, lost):
    """Beside a row that has them all, and without a warning where a single one is left."""
    values = np.array([1.0, 3.0, 7.0, 2.0])
    values[[*lost]] = np.nan
    results = results_of(small({"row": {"a": [2.0, 4.0, 1.0, 9.0], "b": values.tolist()}}))
    found, expected = results.estimate("row", "b", "mse"), FoldMean.of(values[~np.isnan(values)])
    assert (found.n, found.mean) == (expected.n, pytest.approx(expected.mean))
    for ours, alone in (
        (found.two_sd, expected.two_sd),
        (found.half_width, expected.half_width),
    ):
        assert ours == (None if alone is None else pytest.approx(alone))


def test_a_subject_without_a_score_in_one_recording_counts_by_the_other(small):
    def estimate_of(values, subjects):
        cases = (CaseLayout("row", {}, subjects=subjects),)
        table = {"row": {"a": values, "complete": [1.0] * len(values)}}
        results = results_of(small(table, cases=cases))
        return results.estimate("row", "a", "mse")

    lost = estimate_of([1.0, np.nan, 3.0, 7.0, 2.0, 5.0], tuple("aabcde"))
    assert lost == estimate_of([1.0, 3.0, 7.0, 2.0, 5.0], tuple("abcde"))
    assert lost.half_width is not None


@pytest.mark.parametrize(
    ("subjects", "independent", "units"),
    [
        ((), True, [1.0, 3.0, 2.0, 5.0]),
        (("35", "10"), True, [1.5, 4.0]),
        (("35",), True, [2.75]),
        ((), False, [2.75]),
    ],
)
def test_the_interval_of_a_row_is_over_its_units(small, subjects, independent, units):
    """One unit, such as windows of one recording, has none."""
    cases = (CaseLayout("row", {}, subjects=subjects),)
    bundle = small({"row": {"a": [1.0, 3.0, 2.0, 5.0]}}, cases=cases, independent_folds=independent)
    found = results_of(bundle).estimate("row", "a", "mse")
    assert found.mean == pytest.approx(np.mean(units))
    assert found.half_width == (
        pytest.approx(FoldMean.of(units).half_width) if len(units) > 1 else None
    )


@given(st.lists(st.floats(0.1, 9.0), min_size=5, max_size=9), st.sampled_from([1, 2, 3, 4]))
@settings(max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_sentence_board_and_table_have_one_mean_and_the_interval_is_about_it(small, values, people):
    """Also where a person has more folds than another."""
    subjects = tuple(f"{number:02}" for number in range(people))
    cases = (CaseLayout("row", {}, subjects=subjects),)
    results = results_of(small({"row": {"a": values}}, cases=cases))
    found = results.estimate("row", "a", "mse")
    assert found.mean == pytest.approx(np.mean(values))
    (standing,) = standings(results, "mse")
    assert standing.mean == pytest.approx(found.mean)
    assert board_cells(results)["a"].value == pytest.approx(found.mean)
    of_people = [values[person::people] for person in range(people)]
    shares = [len(folds) / len(values) for folds in of_people]
    low, high = mean_interval([np.mean(folds) for folds in of_people], shares=shares)
    assert found.half_width == (pytest.approx((high - low) / 2) if people > 1 else None)


@pytest.mark.parametrize("rows", [{"one", "two", "both"}, {"one", "both"}, {"both"}])
def test_a_mean_over_references_counts_only_without_their_rows(small, rows):
    cases = tuple(
        CaseLayout(name, {}, averages_references=name == "both") for name in ("one", "two", "both")
    )
    results = results_of(small({name: {"a": [1.0]} for name in rows}, cases=cases))
    assert {case.name for case in results.representative_cases("mse")} == (rows - {"both"} or rows)
