"""A side that lost folds is not compared, whatever it lost them by, and every output says so."""

from dataclasses import replace

import pandas as pd
import pytest
from plans import plan_of

from mocapbench.benchmark import comparison
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address

TOY = "toy-interpolation-1"
CASES, FOLDS = ("test 1", "test 2"), 8
HARD = ("test 1", range(5, 8))
LOST = "incomplete: 3 of 16 folds lost"


def records(label, value, metrics=("mse", "smse")):
    return [
        Record(
            *(f"{case}{label}{fold}".encode().hex(), "fit", Address(TOY, 1, case, fold, label)),
            *(0, label, {}, Status.OK),
            scores=dict.fromkeys(metrics, value * (1.0 + 0.1 * fold)),
        )
        for case in CASES
        for fold in range(FOLDS)
    ]


def scored(value):
    return lambda record: replace(record, scores={**record.scores, "mse": value})


def ended(status):
    return lambda record: replace(record, status=status, scores={})


def in_folds(found, where, change):
    case, folds = where
    return [change(r) if r.address.case == case and r.address.fold in folds else r for r in found]


LOSSES = {
    **{status.value: ended(status) for status in Status if status.broken},
    **{str(value): scored(value) for value in (float("nan"), float("inf"), float("-inf"))},
    "no score": lambda record: replace(record, scores={"smse": 1.0}),
}
losses = pytest.mark.parametrize("lose", LOSSES.values(), ids=LOSSES)


@pytest.fixture
def run(tmp_path):
    """Return a writer of run directories, some of whose planned jobs have no record yet."""

    def write(name, *groups, without=()):
        store, found = RunDirectory.create(tmp_path / name), [r for group in groups for r in group]
        for record in found:
            if record not in without:
                store.save(record)
        store.save_plan(plan_of(found))
        return store.path

    return write


def by_case(first, second, metric="mse"):
    rows = comparison.compare(first, second, metrics=[metric], rope=0.02)
    return {row.case: (row, comparison.outcome(row, ("one", "other"))) for row in rows}


@losses
@pytest.mark.parametrize("side", [0, 1])
def test_a_side_that_lost_folds_gets_no_verdict_where_it_did(lose, side):
    sides = [records("knn", 1.0), records("knn", 2.0)]
    sides[side] = in_folds(sides[side], HARD, lose)
    rows, name = by_case(*sides), ("one", "other")[side]
    assert rows["test 1"][1] == f"{name} incomplete: 3 of 8 folds lost"
    assert rows["all cases"][1] == f"{name} {LOST}"
    assert rows["test 2"][1] == "one better"
    row = rows["all cases"][0]
    assert (row.folds, row.contrast.n, row.identical) == (16, 13, False)
    tested = ("advantage", "low", "high", "t_p", "signed_rank_p", "better", "equivalent", "worse")
    assert pd.isna([getattr(row.contrast, name) for name in tested]).all()


@losses
def test_folds_that_both_lost_are_lost_of_either(lose):
    one, other = (in_folds(records("knn", value), HARD, lose) for value in (1.0, 2.0))
    if lose in (LOSSES["nan"], LOSSES["no score"]):  # of nobody: the metric is not defined there
        assert by_case(one, other)["all cases"][1] == "one better"
    else:
        assert by_case(one, other)["all cases"][1] == f"one {LOST}; other {LOST}"


def test_a_metric_that_failed_is_lost_and_the_others_are_compared():
    def fail(record):
        return replace(record, status=Status.FAILED, scores={"smse": record.scores["smse"]})

    one, other = (in_folds(records("knn", value), HARD, fail) for value in (1.0, 2.0))
    assert by_case(one, other)["all cases"][1] == f"one {LOST}; other {LOST}"
    assert by_case(one, other, "smse")["all cases"][1] == "one better"
    elsewhere = [replace(r, seed=1) for r in other]
    with pytest.raises(UsageError, match="do not solve the same problems"):
        by_case([r for r in one if r.scores.keys() == {"smse"}], elsewhere, "smse")


def test_jobs_that_diverged_on_both_sides_are_lost():
    """Scores that are not finite come back from the disk as NaN."""

    def nothing(record):
        return replace(record, scores=dict.fromkeys(record.scores, float("nan")))

    one, other = (in_folds(records("knn", value), HARD, nothing) for value in (1.0, 2.0))
    assert by_case(one, other)["all cases"][1] == f"one {LOST}; other {LOST}"


@losses
def test_a_case_without_any_result_of_one_side_is_a_row(lose):
    rows = by_case(records("knn", 1.0), in_folds(records("knn", 2.0), ("test 1", range(8)), lose))
    assert rows["test 1"][0].contrast.n == 0
    assert rows["test 1"][1] == "other incomplete: 8 of 8 folds lost"
    assert rows["all cases"][1] == "other incomplete: 8 of 16 folds lost"


def test_what_says_nothing_of_a_model_is_not_lost():
    """Recordings that are not on a machine, and a metric that a model never has."""
    other = in_folds(records("knn", 2.0), HARD, ended(Status.DATA_MISSING))
    assert by_case(records("knn", 1.0), other)["all cases"][0].folds == 13
    one = records("knn", 1.0, metrics=("mse", "crps"))
    assert by_case(one, records("knn", 2.0))["all cases"][1] == "one better"
    both = comparison.compare(one, records("knn", 2.0), metrics=["mse", "crps"], rope=0.02)
    assert {row.metric for row in both} == {"mse"}


@pytest.mark.parametrize("lose", [ended(Status.FAILED), scored(float("inf")), None])
def test_every_output_says_how_many_folds_a_model_lost(cli, run, tmp_path, lose):
    """None stands for jobs that an interrupted run never came to."""
    whole = records("nn", 1.0)
    left = in_folds(whole, HARD, lose) if lose else whole
    without = [] if lose else [r for r in whole if r.address.case == "test 1"][5:]
    path = run("run", records("knn", 2.0), left, without=without)
    files = {option: tmp_path / option.strip("-") for option in ("--csv", "--markdown")}
    chosen = ("--models", "nn,knn", "--metrics", "mse")
    assert cli("compare", path, *chosen, *(x for pair in files.items() for x in pair)) == 0
    texts = [cli.printed, *(file.read_text() for file in files.values())]
    assert all(LOST in text for text in texts)
    assert f"nn is {LOST} ({TOY})." in cli.printed
    table = pd.read_csv(files["--csv"]).set_index("case")
    assert table.loc["all cases", ["folds", "first_lost", "second_lost"]].to_list() == [16, 3, 0]


def test_new_failures_of_the_second_run_are_told(cli, run):
    before = run("before", records("knn", 1.0))
    after = run("after", in_folds(records("knn", 0.5), HARD, ended(Status.FAILED)))
    assert cli("compare", before, after, "--metrics", "mse") == 0
    assert f"after is {LOST} ({TOY}, knn)." in cli.printed
    assert "before is" not in cli.printed
    assert "easy ones" in cli.printed
