"""``mocapbench report A B``: what changed between two runs."""

import re
from dataclasses import replace

import numpy as np
import pytest
from plans import plan_of

from mocapbench.benchmark.comparison import compare, run_changes
from mocapbench.benchmark.comparison.rows import POOLED
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address
from mocapbench.metrics.statistics import ROPE
from mocapbench.reports import ChangeVerdict

TOY, FRAMES = "toy-interpolation-1", "missing-frames"
LABELS, CASES = ("knn", "mohgp-3", "oracle"), ("test 1", "test 2")
NAMES = ("before", "after")
ABOUT = {"numpy version": "2.0", "started": "monday", "digest of cmu:07_01": "abc"}


def record(label, case, fold, value, *, task=TOY, metric="mse", **fields):
    key = f"{task}{case}{label}{fold}".encode().hex()
    scores = {metric: value, "smse_pooled": 1.0} if task == TOY else {metric: value}
    return Record(
        **{
            **{"key": key, "fit_key": "fit", "address": Address(task, 1, case, fold, label)},
            **{"seed": 0, "model": label, "parameters": {"k": 3}, "status": Status.OK},
            **{"scores": scores, "provenance": ABOUT, **fields},
        }
    )


def side():
    rng = np.random.default_rng(5)
    toy = [
        record(label, case, fold, float(rng.lognormal()))
        for label in LABELS
        for case in CASES
        for fold in range(5)
    ]
    case = "35-03 three-walkers"
    windows = [
        record("knn", case, fold, float(rng.lognormal()), task=FRAMES, metric="rms_per_frame")
        for fold in range(4)
    ]
    return [*toy, *windows]


def changed(records, change, **where):
    """Return ``records``, with ``change`` made to those whose address has these fields."""
    return [
        change(r) if all(getattr(r.address, k) == v for k, v in where.items()) else r
        for r in records
    ]


def plus(amount):
    def change(r):
        value = r.scores["mse"] + amount * (1.0 + 0.1 * r.address.fold)
        return replace(r, scores={**r.scores, "mse": value})

    return change


def failed(r):
    return replace(r, status=Status.FAILED, scores={}, message="it <broke>", provenance={})


@pytest.fixture
def run(tmp_path):
    """Return a writer of run directories."""

    def write(name, found):
        store = RunDirectory.create(tmp_path / name)
        for each in found:
            store.save(each)
        store.save_plan(plan_of(found))
        return store.path

    return write


def verdicts(changes):
    return {
        (score.task, score.case, score.label, score.metric): score.verdict
        for score in changes.scores
        if score.verdict is not ChangeVerdict.IDENTICAL
    }


def test_a_run_against_itself_shows_no_change(cli, run):
    path = run("run", side())
    assert cli("report", path, path) == 0
    page = (path / "report-against-run.html").read_text(encoding="utf-8")
    assert "0 better and 0 worse" in page
    assert "Nothing: parameters, versions, machines and recordings are the same" in page
    changes = run_changes(side(), side(), NAMES)
    assert changes.counts[ChangeVerdict.IDENTICAL] == len(changes.scores) == 2 * 6 + 1
    lists = ("newly_failing", "newly_passing", "parameters", "provenance", "recordings")
    assert not any(getattr(changes, name) for name in (*lists, "unpaired", "undecided"))
    assert changes.only == ([], [])
    assert "<svg" not in page


@pytest.mark.parametrize(
    ("amount", "verdict"), [(2.0, ChangeVerdict.WORSE), (-2.0, ChangeVerdict.BETTER)]
)
def test_one_cell_that_changed_is_exactly_what_is_shown(cli, run, amount, verdict):
    other = changed(side(), plus(amount), label="knn", case="test 2", task=TOY)
    changes = run_changes(side(), other, NAMES)
    assert verdicts(changes) == {(TOY, "test 2", "knn", "mse"): verdict}
    (score,) = changes.more_than_chance
    assert score.low <= -1.2 * amount <= score.high
    one, two = run("a", side()), run("b", other)
    assert cli("report", one, two) == 0
    page = (two / "report-against-a.html").read_text(encoding="utf-8")
    rows = re.findall(r'<tr><th scope="row">(.*?)</th><td class="text">(.*?)</td>', page)
    assert rows == [("knn", "test 2")]


def test_turning_the_runs_round_turns_the_verdicts_round():
    other = changed(side(), plus(2.0), label="knn", task=TOY)
    other = changed(other, plus(-0.5), label="oracle")
    there, back = (run_changes(*runs, NAMES) for runs in ((side(), other), (other, side())))
    turned = {ChangeVerdict.BETTER: ChangeVerdict.WORSE, ChangeVerdict.WORSE: ChangeVerdict.BETTER}
    assert {k: turned.get(v, v) for k, v in verdicts(there).items()} == verdicts(back)
    intervals = [[(s.low, s.high) for s in changes.scores] for changes in (there, back)]
    turned_round = [(-high, -low) for low, high in intervals[1]]
    np.testing.assert_allclose(intervals[0], turned_round)


def test_one_fold_in_five_may_be_chance_and_windows_allow_no_test():
    first = changed(side(), plus(50.0), label="knn", case="test 1", fold=3)
    assert verdicts(run_changes(side(), first, NAMES)) == {
        (TOY, "test 1", "knn", "mse"): ChangeVerdict.MAY_BE_CHANCE
    }
    windows = changed(side(), lambda r: replace(r, scores={"rms_per_frame": 99.0}), task=FRAMES)
    assert list(verdicts(run_changes(side(), windows, NAMES)).values()) == [ChangeVerdict.UNTESTED]


def random_side(task, metric, n_folds, seed, location):
    rng = np.random.default_rng(seed)
    return [
        record("knn", case.name, fold, float(rng.normal(location, 0.05)), task=task, metric=metric)
        for case in TASKS.get(task).cases[:3]
        for fold in range(n_folds)
    ]


@pytest.mark.parametrize(
    ("task", "metric", "n_folds", "n_units"),
    [
        (TOY, "mse", 6, 6),
        ("toy-synthesis", "variance_ratio", 6, 6),  # folds lie on both sides of its target
        (FRAMES, "rms_per_frame", 6, 1),
        ("marker-gaps", "mpjpe", 12, 4),
        ("walking-synthesis", "mcc", 6, 1),
    ],
)
@pytest.mark.parametrize("location", [1.0, 0.8])
def test_units_advantages_and_verdicts_are_those_of_compare(
    task, metric, n_folds, n_units, location
):
    sides = [random_side(task, metric, n_folds, *of) for of in ((1, 1.0), (2, location))]
    changes = {(s.case, s.metric): s for s in run_changes(*sides, NAMES).scores}
    rows = [r for r in compare(*sides, metrics=[metric], rope=ROPE) if r.case != POOLED]
    for row in rows:
        score = changes[row.case, row.metric]
        found = row.contrast
        assert (score.n, score.first, score.second) == (n_units, found.first, found.second)
        assert (score.low, score.high) == pytest.approx((-found.high, -found.low), nan_ok=True)
        assert score.verdict is row.verdict


def test_a_cell_of_which_a_run_lost_folds_is_not_compared(cli, run):
    """However much better the folds are that it has."""
    other = changed(side(), plus(-2.0), label="knn", case="test 1")
    other = changed(other, failed, label="knn", case="test 1", fold=2)
    changes = run_changes(side(), other, NAMES)
    assert verdicts(changes) == {
        (TOY, "test 1", "knn", metric): ChangeVerdict.INCOMPLETE
        for metric in ("mse", "smse_pooled")
    }
    assert all(np.isnan((score.low, score.high)).all() for score in changes.incomplete)
    one, two = run("a", side()), run("b", other)
    assert cli("report", one, two) == 0
    page = (two / "report-against-a.html").read_text(encoding="utf-8")
    assert "2 are incomplete" in page
    assert "2 scores not compared, because a run lost folds" in page


def test_jobs_that_newly_fail_or_pass_are_listed_with_their_reason(cli, run):
    broken = changed(side(), failed, label="oracle", case="test 1", fold=2)
    one, two = run("a", side()), run("b", broken)
    assert cli("report", one, two, "--to", two / "x.html") == 0
    page = (two / "x.html").read_text(encoding="utf-8")
    assert "1 job newly without a score, 0 newly with one" in page
    assert "oracle · fold 3" in page
    assert "it &lt;broke&gt;" in page
    (passing,) = run_changes(broken, side(), NAMES).newly_passing
    assert (passing.before, passing.after, passing.message) == ("failed", "ok", "it <broke>")


def test_what_differs_besides_is_listed():
    def other_parameters(r):
        return replace(r, parameters={"k": 5})

    def elsewhere(r):
        return replace(r, provenance={**ABOUT, "numpy version": "2.1", "started": "tuesday"})

    changes = run_changes(
        side(), [elsewhere(r) for r in changed(side(), other_parameters, label="knn")], NAMES
    )
    (((label, parameter), tasks),) = changes.parameters.items()
    assert (label, parameter.name, parameter.before, parameter.after) == ("knn", "k", "3", "5")
    assert set(tasks) == {TOY, FRAMES}
    (fact,) = changes.provenance
    assert (fact.name, fact.before, fact.after) == ("numpy version", "2.0", "2.1")


def test_other_recordings_and_versions_are_not_compared_and_named():
    def other_file(r):
        return replace(r, provenance={**ABOUT, "digest of cmu:07_01": "def"})

    def other_version(r):
        return replace(r, address=r.address._replace(version=2))

    other = changed(changed(side(), other_file, case="test 1"), other_version, task=FRAMES)
    changes = run_changes(side(), other, NAMES)
    assert {score.case for score in changes.scores} == {"test 2"}
    assert [(fact.name, fact.before, fact.after) for fact in changes.recordings] == [
        ("cmu:07_01", "abc", "def")
    ]
    assert changes.unpaired == {
        "digest of cmu:07_01 abc against def": 15,
        f"version of {FRAMES} 1 against 2": 4,
    }


def test_what_only_one_run_has_is_named():
    fewer = [r for r in side() if r.address.label != "oracle"]
    assert run_changes(side(), fewer, NAMES).only == ([f"{TOY}: oracle (2 cases)"], [])
    assert run_changes(fewer, side(), NAMES).only == ([], [f"{TOY}: oracle (2 cases)"])


def test_runs_without_anything_in_common_are_refused():
    one, other = ([r for r in side() if r.address.task == task] for task in (TOY, FRAMES))
    with pytest.raises(UsageError, match="in common"):
        run_changes(one, other, NAMES)
    seeds = [replace(r, seed=1) for r in side()]
    with pytest.raises(UsageError, match="seed 0 against 1"):
        run_changes(side(), seeds, NAMES)


def test_a_wrong_request_is_refused_and_writes_nothing(cli, run, tmp_path):
    path = run("run", side())
    before = set(tmp_path.rglob("*"))
    assert cli("report", path, tmp_path / "nowhere") == 2
    assert "is not a mocapbench run" in cli.printed
    assert cli("report", path) == 2
    assert "expected two run directories, got 1" in cli.printed
    assert cli("report", path, path, "--to", tmp_path) == 2
    assert set(tmp_path.rglob("*")) == before
