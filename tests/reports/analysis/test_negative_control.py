"""The negative control: who passes, who fails, by what and where."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from scipy import stats

from mocapbench.reports.analysis.negative_control import (
    LEAST_VARIANCE_RATIO,
    NEAR_ZERO,
    negative_control,
)
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.tables.negative_control import negative_control_table
from mocapbench.reports.tables.scores import score_table

CONTROL = {
    "mlc": [0.05, -0.06, 0.02, -0.03],
    "mcc": [7.0, 7.4, 6.8, 7.1],
    "variance_ratio": [5.0] * 4,
}
GOOD = {
    "mlc": [0.8, 0.7, 0.9, 0.75],
    "mcc": [9.0, 9.3, 8.9, 9.2],
    "variance_ratio": [1.0, 1.2, 0.8, 1.1],
}


@pytest.fixture
def check(small):
    """Return the results of one task of two cases and two folds, from {label: {metric: [4]}}."""

    def make(entrants, **fields):
        cells = {"one": slice(0, 2), "two": slice(2, 4)}
        bundles = [
            small(
                {
                    case: {label: values[metric][own] for label, values in entrants.items()}
                    for case, own in cells.items()
                },
                metric=metric,
                **fields,
            )
            for metric in ("mlc", "mcc", "variance_ratio")
        ]
        scores = pd.concat([bundle.scores for bundle in bundles])
        whole = replace(bundles[0], scores=scores)
        return task_results(whole, whole.layouts[0])

    return make


def verdicts(results):
    return {result.label: result.verdict for result in negative_control(results)}


def failures(results):
    """Return by what each entrant that must pass fails."""
    return {
        result.label: [measure.name for measure in result.measures if not measure.passed]
        for result in negative_control(results)
        if result.failed
    }


def test_what_resembles_passes_and_what_does_not_fails_with_its_cells(check):
    stranger = {**CONTROL, "mlc": [0.2, -0.1, 0.1, -0.2]}
    results = check({"good": GOOD, "stranger": stranger, "control": CONTROL})
    assert verdicts(results) == {"control": "passed", "good": "passed", "stranger": "failed"}
    assert failures(results) == {"stranger": ["MLC", "MCC"]}
    stranger = next(found for found in negative_control(results) if found.label == "stranger")
    of_mlc = [(cell.case, cell.fold) for cell in stranger.measures[0].offending]
    assert of_mlc == [("one", 1), ("two", 1)]


def test_the_interval_is_that_of_the_paired_differences(check):
    (_, good) = negative_control(check({"good": GOOD, "control": CONTROL}))
    differences = np.subtract(GOOD["mlc"], CONTROL["mlc"])
    low, high = stats.ttest_1samp(differences, 0.0).confidence_interval(0.95)
    estimate = good.measures[0].estimate
    assert estimate.mean == pytest.approx(differences.mean())
    assert estimate.half_width == pytest.approx((high - low) / 2)
    assert estimate.n == good.n_cells == 4


def test_a_mean_that_is_above_by_chance_alone_fails(check):
    scattered = {**GOOD, "mlc": [0.9, -0.8, 0.9, 0.1]}
    assert failures(check({"scattered": scattered, "control": CONTROL})) == {"scattered": ["MLC"]}


def test_pairs_count_and_not_levels(check):
    """Cells that differ by much hide no difference that is the same in all of them."""
    levels = np.array([0.0, 3.0, 6.0, 9.0])
    entrants = {
        "good": {**GOOD, "mcc": levels + np.array([1.0, 1.1, 0.9, 1.0])},
        "control": {**CONTROL, "mcc": levels},
    }
    assert failures(check(entrants)) == {}


@pytest.mark.parametrize("ratio", [0.0, 0.3, LEAST_VARIANCE_RATIO - 0.01])
def test_a_sampler_that_collapses_fails_however_well_it_scores(check, ratio):
    collapsed = {"mlc": [0.99] * 4, "mcc": [12.0] * 4, "variance_ratio": [ratio] * 4}
    found = check({"good": GOOD, "collapsed": collapsed, "control": CONTROL})
    assert failures(found) == {"collapsed": ["variance ratio"]}


def test_drawing_too_much_is_no_way_to_score_well_and_passes(check):
    assert (
        failures(check({"wide": {**GOOD, "variance_ratio": [4.0] * 4}, "control": CONTROL})) == {}
    )


@pytest.mark.parametrize(
    ("mlc", "passes"),
    [
        ([0.05, -0.06, 0.02, -0.03], True),
        ([0.9, -0.7, 0.8, -0.6], True),  # scattered, around 0
        ([0.08, 0.081, 0.079, 0.08], True),  # not 0, but within the limit
        ([0.12, 0.121, 0.119, 0.12], False),
        ([-0.5, -0.51, -0.49, -0.5], False),
    ],
)
def test_a_control_must_be_near_zero(check, mlc, passes):
    results = check({"good": GOOD, "control": {**CONTROL, "mlc": mlc}})
    control = negative_control(results)[0]
    assert control.passed is passes
    cells = control.measures[0].offending
    assert all(abs(cell.value) > NEAR_ZERO for cell in cells)
    assert bool(cells) is not passes


def test_an_exempt_entrant_is_shown_and_fails_nothing(check):
    reason = "draws around no trend"
    results = check({"prior": CONTROL, "good": GOOD, "control": CONTROL}, exempt={"prior": reason})
    assert verdicts(results)["prior"] == "need not pass"
    assert failures(results) == {}
    table = negative_control_table(results)
    assert table.notes[-1] == f"prior need not pass: it {reason}."
    assert [cell.text for cell in table.rows[-1]][:3] == ["control", "passed", "4"]
    assert [cell.text for cell in table.rows[-1][-2:]] == ["–", "–"]


def test_an_entrant_that_lost_its_scores_fails(check):
    lost = {metric: [np.nan] * 4 for metric in GOOD}
    results = check({"lost": lost, "good": GOOD, "control": CONTROL})
    assert failures(results) == {"lost": ["MLC", "MCC", "variance ratio"]}
    assert negative_control_table(results).rows[0][2].text == "0"


def test_without_a_control_or_with_one_cell_of_it_nothing_is_checked(check):
    one = {metric: [values[0], *[np.nan] * 3] for metric, values in CONTROL.items()}
    for entrants in ({"good": GOOD}, {"good": GOOD, "control": one}):
        results = check(entrants)
        assert negative_control(results) == ()
        assert negative_control_table(results) is None


@pytest.mark.parametrize(
    ("label", "reason"),
    [
        ("oracle", "knows the generating process: a limit"),
        ("control", "negative control: samples of an unrelated process"),
        ("replay", "repeats its training recordings: the score of samples that are not new"),
    ],
)
def test_limits_and_controls_are_not_ranked_and_a_note_says_so(check, label, reason):
    results = check({"good": GOOD, label: {**CONTROL, "mlc": [0.99] * 4}})
    assert results.best("one", "mlc") == {"good"}
    assert f"{label} ({reason}) is not ranked." in score_table(results, "mlc").notes


def test_a_failure_that_no_cell_explains_is_explained(check):
    scattered = {**GOOD, "mlc": [2.0, 0.1, 0.1, 0.1]}
    table = negative_control_table(check({"scattered": scattered, "control": CONTROL}))
    assert [cell.note for cell in table.rows[0][3:]] == ["too few cells to tell", "", ""]
