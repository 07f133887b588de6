"""The negative control: who passes, who fails, by what and where."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy import stats

from mocapbench.reports.analysis.negative_control import (
    ENOUGH_CELLS,
    LEAST_VARIANCE_RATIO,
    NEAR_ZERO,
    Decision,
    negative_control,
)
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.figures.styles import model_styles
from mocapbench.reports.scores.table import score_table
from mocapbench.reports.tables.control import negative_control_table

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
    """Return the results of one task from {label: {metric: [a value per fold]}}.

    The values are those of every case, so that four folds are eight cells.
    """

    def make(entrants, cases=("one", "two"), **fields):
        bundles = [
            small(
                {
                    case: {label: values[metric] for label, values in entrants.items()}
                    for case in cases
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
        result.label: [m.name for m in result.measures if m.decision is Decision.FAILED]
        for result in negative_control(results)
        if result.failed
    }


def test_what_resembles_passes_and_what_does_not_fails_with_its_cells(check):
    stranger = {**CONTROL, "mlc": [0.2, -0.1, 0.1, -0.2]}
    results = check({"good": GOOD, "stranger": stranger, "control": CONTROL})
    assert verdicts(results) == {"control": "passed", "good": "passed", "stranger": "failed"}
    assert failures(results) == {"stranger": ["MLC", "MCC"]}
    stranger = next(found for found in negative_control(results) if found.label == "stranger")
    of_mlc = list(stranger.measures[0].offending)
    assert of_mlc == [("one", 1), ("one", 3), ("two", 1), ("two", 3)]


def test_the_interval_is_that_of_the_paired_differences(check):
    (_, good) = negative_control(check({"good": GOOD, "control": CONTROL}))
    differences = np.tile(np.subtract(GOOD["mlc"], CONTROL["mlc"]), 2)
    low, high = stats.ttest_1samp(differences, 0.0).confidence_interval(0.95)
    estimate = good.measures[0].estimate
    assert estimate.mean == pytest.approx(differences.mean())
    assert estimate.half_width == pytest.approx((high - low) / 2)
    assert estimate.n == good.n_cells == 8


def test_a_mean_that_is_above_by_chance_alone_fails(check):
    scattered = {**GOOD, "mlc": [0.9, -0.8, 0.9, -0.1]}
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
    assert (control.decision is Decision.PASSED) is passes
    cells = control.measures[0].offending
    assert all(abs(value) > NEAR_ZERO for value in cells.values())
    assert bool(cells) is not passes


def test_an_exempt_entrant_is_shown_and_fails_nothing(check):
    reason = "draws around no trend"
    results = check({"prior": CONTROL, "good": GOOD, "control": CONTROL}, exempt={"prior": reason})
    assert verdicts(results)["prior"] == "need not pass"
    assert failures(results) == {}
    table = negative_control_table(results)
    assert table.notes[-1] == f"prior need not pass: it {reason}."
    assert [cell.text for cell in table.rows[-1]][:3] == ["control", "passed", "8"]
    assert [cell.text for cell in table.rows[-1][-2:]] == ["–", "–"]


def test_an_entrant_that_lost_its_scores_fails(check):
    lost = {metric: [np.nan] * 4 for metric in GOOD}
    results = check({"lost": lost, "good": GOOD, "control": CONTROL})
    assert failures(results) == {"lost": ["MLC", "MCC", "variance ratio"]}
    assert negative_control_table(results).rows[0][2].text == "0"


def test_without_a_control_nothing_is_checked(check):
    lost = {metric: [np.nan] * 4 for metric in CONTROL}
    for entrants in ({"good": GOOD}, {"good": GOOD, "control": lost}):
        results = check(entrants)
        assert negative_control(results) == ()
        assert negative_control_table(results) is None


def folds(n, values):
    return {metric: several[:n] for metric, several in values.items()}


def test_one_cell_decides_nothing(check):
    results = check({"good": folds(1, GOOD), "control": folds(1, CONTROL)}, cases=("one",))
    assert set(verdicts(results).values()) == {"undecided"}
    assert failures(results) == {}


@pytest.mark.parametrize(
    ("mlc", "verdict"),
    [
        ([0.8, 0.7, 0.9], "passed"),
        ([0.9, 0.1, 0.3], "undecided"),
        ([0.3, -0.2, 0.1], "undecided"),
        ([-0.7, -0.8, -0.75], "failed"),
    ],
)
def test_few_cells_fail_only_whom_their_interval_refutes(check, mlc, verdict):
    entrants = {"one": {**folds(3, GOOD), "mlc": mlc}, "control": folds(3, CONTROL)}
    assert verdicts(check(entrants, cases=("one",)))["one"] == verdict


@pytest.mark.parametrize(
    ("ratios", "verdict"),
    [([0.7, 0.3], "undecided"), ([0.1, 0.1], "failed"), ([0.7, 0.9], "passed")],
)
def test_few_cells_tell_a_sampler_that_collapses(check, ratios, verdict):
    entrants = {"one": {**folds(2, GOOD), "variance_ratio": ratios}, "control": folds(2, CONTROL)}
    entrants["one"]["mlc"] = [0.8, 0.8 + CONTROL["mlc"][1] - CONTROL["mlc"][0]]
    entrants["one"]["mcc"] = [9.0, 9.0 + CONTROL["mcc"][1] - CONTROL["mcc"][0]]
    assert verdicts(check(entrants, cases=("one",)))["one"] == verdict


@pytest.mark.slow
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=8))
def test_a_decision_follows_from_the_interval_and_the_number_of_cells(check, mlc):
    n = len(mlc)
    entrants = {
        "one": {"mlc": mlc, "mcc": [9.0] * n, "variance_ratio": [1.0] * n},
        "control": {"mlc": [0.0] * n, "mcc": [7.0] * n, "variance_ratio": [1.0] * n},
    }
    (measure, *_) = negative_control(check(entrants, cases=("one",)))[1].measures
    half = np.inf if n == 1 else measure.estimate.half_width
    assert (measure.decision is Decision.PASSED) == (measure.estimate.mean - half > 0)
    if measure.decision is Decision.FAILED:
        assert min(mlc) <= 0
        assert n >= ENOUGH_CELLS or measure.estimate.mean + half <= 0


def test_enough_cells_are_the_fewest_of_which_a_sign_test_can_reject():
    assert 2.0**-ENOUGH_CELLS <= 0.025 < 2.0 ** (1 - ENOUGH_CELLS)


def test_an_exempt_entrant_is_never_undecided(check):
    entrants = {"prior": folds(1, CONTROL), "control": folds(1, CONTROL)}
    results = check(entrants, cases=("one",), exempt={"prior": "draws around no trend"})
    assert verdicts(results)["prior"] == "need not pass"


@pytest.mark.parametrize("label", ["oracle", "control", "replay"])
def test_limits_and_controls_stand_below_and_are_not_ranked(check, label):
    results = check({"good": GOOD, label: {**CONTROL, "mlc": [0.99] * 4}})
    assert results.best_label("one", "mlc") == "good"
    rows = score_table(results, "mlc", model_styles([results.layout]))["rows"]
    assert [(row.label, row.kind) for row in rows] == [("good", "ranked"), (label, "reference")]


def test_a_measure_that_meets_its_criterion_in_every_cell_has_not_failed(check):
    scattered = {**GOOD, "mlc": [4.0, 0.1, 0.1, 0.1]}
    results = check({"scattered": scattered, "control": CONTROL})
    assert verdicts(results)["scattered"] == "undecided"
    table = negative_control_table(results)
    assert [cell.note for cell in table.rows[0][3:]] == ["too few cells to tell", "", ""]
    assert table.rows[0][1].text == "undecided"
