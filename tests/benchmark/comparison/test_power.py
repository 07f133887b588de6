import math

import numpy as np
import pandas as pd
import pytest
from plans import plan_of

from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address
from mocapbench.metrics.statistics import power_of_t_test, unit_means

TOY, FRAMES = "toy-interpolation-1", "missing-frames"
GOOD = [1.0, 1.2, 0.9, 1.1, 1.0, 1.3]
BAD = [1.5, 1.6, 1.5, 1.4, 1.9, 1.8]
WORST = [9.0, 8.0, 7.0, 8.0, 9.0, 6.0]
CASE = "test 1"
GIVEN = {"knn": GOOD, "nn": BAD, "linear": WORST}


def write_records(store, task, cases, metric):
    """Save a record for each case, label and fold of scores; None is a job that failed."""
    found = [
        Record(
            key=f"{task}{case}{label}{fold}".encode().hex(),
            fit_key=f"{task}{case}{label}{fold}".encode().hex(),
            address=Address(task, 1, case, fold, label),
            seed=0,
            model=label,
            parameters={},
            status=Status.FAILED if value is None else Status.OK,
            scores={} if value is None else {metric: value},
        )
        for case, by_label in cases.items()
        for label, values in by_label.items()
        for fold, value in enumerate(values)
    ]
    for record in found:
        store.save(record)
    return found


@pytest.fixture
def run(tmp_path):
    """Return a writer of run directories, from scores by task, case and label."""

    def write(tasks, metric="smse_pooled"):
        store = RunDirectory.create(tmp_path / "run")
        parts = [write_records(store, task, cases, metric) for task, cases in tasks.items()]
        store.save_plan(plan_of([record for part in parts for record in part]))
        return store.path

    return write


@pytest.fixture
def planned(cli, tmp_path):
    """Return a function from arguments of the command to the rows of its CSV file, by case."""

    def plan(*arguments):
        assert cli("power", *arguments, "--csv", tmp_path / "rows.csv") == 0
        return pd.read_csv(tmp_path / "rows.csv").set_index("case")

    return plan


def test_the_spread_is_the_deviation_of_the_difference_of_the_best_and_the_next(run, planned):
    row = planned(run({TOY: {CASE: GIVEN}})).loc[CASE]
    differences = np.subtract(BAD, GOOD)
    assert (row["first"], row["second"], row["n"]) == ("knn", "nn", 6)
    assert row["difference"] == pytest.approx(differences.mean())
    assert row["spread"] == pytest.approx(differences.std(ddof=1))
    assert row["spread_low"] < row["spread"] < row["spread_high"]


def test_what_is_said_to_show_and_to_be_needed_has_the_power_asked_for(run, planned):
    row = planned(run({TOY: {CASE: GIVEN}}), "--people", "6,40", "--alpha", ".01").loc[CASE]
    for n, shown in ((6, row["shown_now"]), (6, row["shown_by_6"]), (40, row["shown_by_40"])):
        assert power_of_t_test(n, shown, row["spread"], 0.01) == pytest.approx(0.8)
    power = [
        power_of_t_test(n, row["difference"], row["spread"], 0.01)
        for n in (row["needed"] - 1, row["needed"])
    ]
    assert power[0] < 0.8 <= power[1]


def test_as_many_are_needed_for_a_difference_as_show_it(run, planned):
    path = run({TOY: {CASE: GIVEN}})
    shown = planned(path, "--people", "40").loc[CASE, "shown_by_40"]
    row = planned(path, "--difference", shown * (1.0 + 1e-9)).loc[CASE]
    assert (row["claim"], row["needed"]) == (pytest.approx(shown), 40)


def test_exchanging_two_models_turns_the_difference_round_and_nothing_else(run, planned):
    path = run({TOY: {CASE: GIVEN}})
    one, other = (planned(path, "--models", pair).loc[CASE] for pair in ("nn,linear", "linear,nn"))
    assert one["difference"] == pytest.approx(np.mean(WORST) - np.mean(BAD))
    assert other["difference"] == -one["difference"]
    for name in ("spread", "shown_now", "shown_by_30", "needed"):
        assert one[name] == pytest.approx(other[name])


def test_windows_of_one_person_are_one_unit_and_too_few_are_not_planned(run, planned):
    windows = {
        f"{walk} three-walkers": {"knn": GOOD, "nn": [value + shift for value in BAD]}
        for shift, walk in enumerate(("35-03", "07-01"))
    }
    path = run({FRAMES: windows, TOY: {CASE: GIVEN}}, "mse")
    rows = planned(path, "--metric", "mse")
    few = rows[rows["task"] == FRAMES]
    assert set(few["finding"]) == {"too few to test (1 subject)", "too few to test (2 subjects)"}
    assert (
        few[["spread", "spread_high", "shown_now", "shown_by_30", "needed"]].isna().all(axis=None)
    )
    assert rows.loc[CASE, "spread"] > 0.0


def test_unequal_shares_count_for_what_they_are_worth(run, planned):
    cases = {"test 1": {"knn": GOOD, "nn": BAD}, "test 2": {"knn": GOOD[:3], "nn": BAD[3:]}}
    row = planned(run({TOY: cases})).loc["all cases"]
    differences = [*np.subtract(BAD, GOOD), *np.subtract(BAD[3:], GOOD[:3])]
    means = unit_means(differences, [1 / 12] * 6 + [1 / 6] * 3)
    assert row["worth"] == pytest.approx(float(means.freedom) + 1.0)
    assert row["worth"] < row["n"] == 9
    assert row["spread"] == pytest.approx(float(means.error) * math.sqrt(row["worth"]))
    assert power_of_t_test(row["worth"], row["shown_now"], row["spread"]) == pytest.approx(0.8)


def test_a_row_of_which_a_model_lost_folds_is_not_planned(run, planned):
    lost = {"knn": GOOD, "nn": [*BAD[:5], None]}
    cases = {"test 1": lost, "test 2": {"knn": GOOD, "nn": BAD}}
    rows = planned(run({TOY: cases}), "--models", "knn,nn")
    assert rows.loc["test 1", "finding"] == "incomplete"
    assert math.isnan(rows.loc["test 1", "shown_by_30"])
    assert rows.loc["test 2", "spread"] > 0.0


def test_a_model_that_is_another_is_no_rival_of_it_and_has_no_spread(run, planned):
    cases = {
        "test 1": GIVEN | {"best-of": GOOD},
        "test 2": {"knn": GOOD, "best-of": BAD},
    }
    path = run({TOY: cases})
    assert set(planned(path).loc["test 1", ["first", "second"]]) <= {"knn", "best-of", "nn"}
    assert planned(path).loc["test 1", "second"] == "nn"
    row = planned(path, "--models", "knn,best-of").loc["test 1"]
    assert row["finding"] == "the same difference in all"
    assert math.isnan(row["needed"])


def test_no_number_of_people_shows_next_to_nothing(cli, run):
    assert cli("power", run({TOY: {CASE: GIVEN}}), "--difference", "1e-9") == 0
    assert "n for 1e-09" in cli.printed
    assert "over 1000000" in cli.printed


def test_the_table_says_what_was_measured_and_what_is_needed(cli, run):
    assert cli("power", run({TOY: {CASE: GIVEN}}), "--people", "20") == 0
    assert f"{TOY}: {METRICS.get('smse_pooled').title} (lower is better)" in cli.printed
    assert "case n models by spread n show 20 show n for this" in cli.printed
    assert "test 1 6 knn, nn 0.533 0.207 [0.129, 0.507] 0.296 0.136 5" in cli.printed
    assert "with the probability 0.8" in cli.printed


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--tasks", "nonsense"), "unknown task of the run 'nonsense': known: " + TOY),
        (("--tasks", FRAMES), f"unknown task of the run '{FRAMES}': known: {TOY}"),
        (("--metric", "mcc"), "unknown metric of these tasks 'mcc': known: smse_pooled"),
        (
            ("--models", "knn,no"),
            "unknown ranked model of these tasks 'no': did you mean nn or knn?",
        ),
        (("--models", "knn"), "power: expected two models to compare, got knn"),
        (("--models", "knn,nn,linear"), "expected two models to compare, got knn, nn, linear"),
        (("--models", "knn,knn"), "expected two models to compare, got knn, knn"),
        (("--people", "1"), "numbers of people from 5, as fewer are not tested, got --people 1"),
        (("--people", "30,-7"), "got --people 30,-7"),
        (("--people", "many"), "got --people many"),
        (("--people", ","), "as fewer are not tested, got --people"),
        (("--models", ","), "expected two models to compare, got neither"),
        (("--difference", "0"), "expected a difference above 0, got --difference 0"),
        (("--difference", "nan"), "expected a difference above 0, got --difference nan"),
        (("--alpha", "0.9"), "got --alpha 0.9 and --power 0.8"),
        (("--power", "1"), "got --alpha 0.05 and --power 1"),
        (("--csv", "no/where.csv"), "expected a file in a folder that exists"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_what_cannot_be_planned_is_said_in_one_line(cli, run, arguments, message):
    assert cli("power", run({TOY: {CASE: GIVEN}}), *arguments) == 2
    assert message in cli.printed
    assert cli.printed.count("error: ") == 1 or "Invalid value" in cli.printed


def test_a_run_without_enough_units_says_so(cli, run):
    few = {label: values[:4] for label, values in GIVEN.items()}
    assert cli("power", run({TOY: {CASE: few}})) == 2
    assert cli.printed == (
        "error: power: expected scores of two models for 5 or more people or folds, whose "
        "difference varies, got: too few to test (4 folds); run more of them (`mocapbench run "
        "--folds`), or add recordings of more people"
    )


def test_a_run_of_one_model_says_so(cli, run):
    assert cli("power", run({TOY: {CASE: {"knn": GOOD}}})) == 2
    assert cli.printed == (
        "error: power: expected two models with different scores in each fold of some case, got "
        "none in this run; choose two with --models, or another metric with --metric"
    )


@pytest.mark.parametrize(
    ("others", "finding", "advice"),
    [
        ([value + 0.1 for value in GOOD], "the same difference in all", "choose other models"),
        (GOOD[:-1], "incomplete", "one has scores that the other lacks"),
    ],
)
def test_what_stands_against_a_plan_of_enough_people_is_said(cli, run, others, finding, advice):
    given = {"knn": GOOD, "nn": others}
    assert cli("power", run({TOY: {CASE: given}}), "--models", "knn,nn") == 2
    assert f"got: {finding}; {advice}" in cli.printed
    assert "run more of them" not in cli.printed


def test_a_folder_that_is_no_run_says_so(cli, tmp_path):
    assert cli("power", tmp_path / "absent") == 2
    assert "absent" in cli.printed
