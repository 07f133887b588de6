"""The conformance kit names the fault of a task that does not conform."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from mocapbench.benchmark import TASKS, Case, Entrant, Profile, Task, archive_at
from mocapbench.benchmark.testing import ConformanceError, check_task

TASK = TASKS.get("toy-interpolation-1")


@pytest.mark.parametrize("task", [Task, "toy-interpolation-1"])
def test_what_is_no_task_is_refused(task):
    with pytest.raises(ConformanceError, match=r"expected a mocapbench\.benchmark\.Task"):
        check_task(task)


def _unseeded(pose, seeds, archive):
    fold = int(np.random.default_rng().integers(10**6))
    return pose(replace(seeds, address=seeds.address._replace(fold=fold)), archive)


def _same_fold(pose, seeds, archive):
    return pose(replace(seeds, address=seeds.address._replace(fold=0)), archive)


def _nothing_hidden(pose, seeds, archive):
    problem = pose(seeds, archive)
    return replace(problem, given=(problem.given[0].with_values(problem.truth[0]),))


def _other_truth(pose, seeds, archive):
    problem = pose(seeds, archive)
    return replace(problem, truth=(problem.truth[0] + 1.0,))


def _other_training(pose, seeds, archive):
    problem = pose(seeds, archive)
    return replace(problem, train=problem.train[: 1 + seeds.fold])


def _unposable(pose, seeds, archive):
    raise RuntimeError("no process")


@pytest.mark.parametrize(
    ("fault", "complaint"),
    [
        (_unseeded, "again at the same address"),
        (_same_fold, "another problem in another fold, got the same"),
        (_nothing_hidden, "expected hidden entries in child-5, got none"),
        (_other_truth, "the truth where it is visible"),
        (_unposable, "it poses a problem, got RuntimeError: no process"),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_the_fault_of_a_problem_is_named(fault, complaint):
    cases = tuple(replace(case, problem=partial(fault, case.problem)) for case in TASK.cases)
    with pytest.raises(ConformanceError, match=complaint):
        check_task(replace(TASK, cases=cases))


def test_references_that_no_seed_decides_are_a_fault():
    def other_references(pose, seeds, archive):
        problem = pose(seeds, archive)
        return replace(problem, references=np.random.default_rng().random((2, 30, 3)))

    task = TASKS.get("toy-synthesis")
    cases = tuple(replace(c, problem=partial(other_references, c.problem)) for c in task.cases)
    with pytest.raises(ConformanceError, match="the same problem again at the same address"):
        check_task(replace(task, cases=cases))


def _case(name):
    return replace(TASK.cases[0], name=name)


@pytest.mark.parametrize(
    ("field", "value", "complaint"),
    [
        ("cases", (_case("a"), _case("a")), "every case under a name of its own, got 'a' twice"),
        ("entrants", (Entrant("x", "knn"), Entrant("x", "moa")), "every entrant under a name"),
        ("entrants", (Entrant("linear", "knn"),), "not another model's name, got 'linear' for"),
        ("entrants", (Entrant("a/b", "knn"),), "without slashes, got 'a/b'"),
        ("entrants", (Entrant(" ", "knn"),), "entrants with labels"),
        (
            "entrants",
            (Entrant("k", "knn", {"n_neigh": 5}),),
            "n_neighbors.*, got 'n_neigh'",
        ),
        ("version", 0, "expected a version from 1, got 0"),
        ("requires", (int,), "expected abilities from mocapbench.baselines"),
        ("profiles", {}, "at least one profile, got none"),
        ("profiles", {"smoke": Profile(("test 0",), 1)}, "cases of profile smoke"),
        (
            "profiles",
            {"smoke": Profile(("test 1",), 0)},
            "'smoke': .* whole .* from 1, got 0",
        ),
        ("profiles", {"smoke": Profile(("test 1",), 1.5)}, "whole number of folds from 1, got 1.5"),
        ("profiles", {"smoke": Profile((), 1)}, "profile 'smoke': expected one or more cases"),
        ("max_folds", 1, "expected 1 to 1 folds in profile smoke, got 2"),
    ],
)
def test_the_fault_of_a_task_is_named(field, value, complaint):
    with pytest.raises(ConformanceError, match=complaint):
        check_task(replace(TASK, **{field: value}))


@pytest.mark.parametrize(
    ("field", "value", "complaint"),
    [
        ("metrics", (), "expected metrics to show on its page, got none"),
        ("metrics", ("msee",), "metrics of its page: unknown metric 'msee': did you mean .*mse"),
        ("published_models", {"me": "ME"}, r"published_models among .* got \['me'\]"),
        ("published_metrics", {"pit": "PIT"}, r"published_metrics among .* got \['pit'\]"),
        ("published_rows", {"test 0": "row"}, r"published_rows among .* got \['test 0'\]"),
        ("illustrated", ("test 0",), r"illustrated cases among .* got \['test 0'\]"),
    ],
)
def test_a_name_on_the_page_that_the_task_does_not_have_is_named(field, value, complaint):
    with pytest.raises(ConformanceError, match=complaint):
        check_task(replace(TASK, page=replace(TASK.page, **{field: value})))


def test_a_task_that_cannot_be_tried_without_recordings_is_refused(tmp_path, monkeypatch):
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path))
    case = Case("test 1", TASK.cases[0].problem, given=("cmu:02_01",))
    profiles = {"smoke": Profile(("test 1",), 1)}
    page = replace(TASK.page, published_rows={})
    task = replace(TASK, cases=(case,), profiles=profiles, page=page)
    with pytest.raises(ConformanceError, match="add one on generated data"):
        check_task(task, archive_at(tmp_path))


def test_training_that_is_named_is_the_same_in_all_folds():
    case = replace(TASKS.get("missing-frames").case("synthetic 1"), training="walkers")
    profiles = {"quick": Profile((case.name,), folds=2)}
    task = replace(TASKS.get("missing-frames"), cases=(case,), profiles=profiles)
    task = replace(task, page=replace(task.page, illustrated=(), published_rows={}))
    check_task(task)
    wrong = replace(case, problem=partial(_other_training, case.problem))
    with pytest.raises(ConformanceError, match="the training recordings of another fold"):
        check_task(replace(task, cases=(wrong,)))
