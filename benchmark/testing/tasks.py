"""Whether a task is consistent and its problems are functions of their address."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import joblib
import numpy as np

from mocapbench.baselines.declarations.needs import describe_needs, find_met_needs
from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.consistency import require_consistent
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.runs.request import entrants
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import Case, Task
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.benchmark.testing.errors import ConformanceError, raised_by, require, require_equal
from mocapbench.datasets import Archive

__all__ = ["check_task"]


def check_task(task: Task, archive: Archive | None = None) -> None:
    """Check that a task is consistent, and its problems pure functions of their address.

    Parameters
    ----------
    task : Task
    archive : Archive or None
        Where recordings are; the default one if None. The first case whose recordings are there
        is posed.

    Raises
    ------
    ConformanceError
        At the first thing that is wrong.
    """
    advice = "pass the task itself, not its name"
    require(isinstance(task, Task), "a mocapbench.benchmark.Task", repr(task), advice)
    with raised_by(f"task {task.name}", "it is consistent"):
        _check_names(task)
        _check_profiles(task)
    with raised_by(f"task {task.name}", "it poses a problem"):
        _check_problems(task, archive or archive_at())


def _check_names(task: Task) -> None:
    cases = [case.name for case in task.cases]
    labels = [entrant.label for entrant in entrants(task)]
    require_consistent(task)
    require(task.version >= 1, "a version from 1", task.version, "raise it when problems change")
    _require_among("published_models", task.page.published_models, labels)
    _require_among("published_metrics", task.page.published_metrics, task.page.metrics)
    _require_among("published_rows", task.page.published_rows, cases)
    _require_among("illustrated cases", task.page.illustrated, cases)


def _check_profiles(task: Task) -> None:
    require(task.profiles, "at least one profile", "none", "say what smoke, quick and paper run")
    for name, profile in task.profiles.items():
        cases = [case.name for case in task.cases]
        _require_among(f"cases of profile {name}", profile.cases, cases)
        folds = profile.folds
        most = folds if task.max_folds is None else task.max_folds
        expected = f"1 to {most} folds in profile {name}"
        require(folds <= most, expected, folds, "change its Profile")


def _check_problems(task: Task, archive: Archive) -> None:
    case = _posable(task, archive)
    one, two = (_pose_problem(task, case, 0, archive) for _ in range(2))
    require(one.train, "recordings to learn from", "none", "fill Problem.train")
    advice = "draw from seeds.generator alone"
    for a, b in zip(one.train, two.train, strict=True):
        require(a.name == b.name, f"the recording {a.name} again", b.name, advice)
        require_equal(a.values, b.values, f"{a.name} again at the same address", advice)
    if {"fills entries", "fills frames"} & set(task.requires):
        _check_masks(one, two)
        if task.max_folds != 1:
            other = _pose_problem(task, case, 1, archive)
            _check_folds(one, other)
            if case.training:
                _check_training(one, other)
    lacking = describe_needs(set(task.meets) - find_met_needs(one))
    require(not lacking, "problems that meet what the task says", lacking, "leave it out of meets")
    # What no model sees counts too: the truth, the references and the process.
    same = joblib.hash(one) == joblib.hash(two)
    require(same, "the same problem again at the same address", "another", advice)


def _check_masks(one: Any, two: Any) -> None:
    """Check that the same entries are hidden at the same address, and nothing but hidden."""
    for given, again, truth in zip(one.given, two.given, one.truth, strict=True):
        advice = "draw masks from seeds.generator('mask')"
        require_equal(given.values, again.values, "the same mask at the same address", advice)
        hidden = int(np.isnan(given.values).sum())
        require(hidden, f"hidden entries in {given.name}", "none", "hide them with Recording.hide")
        seen = given.visible
        advice = "take the truth from the recording that is hidden in part"
        require_equal(truth[seen], given.values[seen], "the truth where it is visible", advice)


def _check_folds(one: Any, other: Any) -> None:
    same = np.array_equal(one.given[0].values, other.given[0].values, equal_nan=True)
    require(not same, "another problem in another fold", "the same", "draw anew for every fold")


def _check_training(one: Any, other: Any) -> None:
    same = joblib.hash(one.train) == joblib.hash(other.train)
    advice = "leave out Case.training"
    require(same, "the training recordings of another fold, which are named", "others", advice)


def _posable(task: Task, archive: Archive) -> Case:
    for case in task.cases:
        if all(map(archive.available, case.recordings)):
            return case
    raise ConformanceError(
        "expected a case whose recordings are at hand, got none: add one on generated data, so "
        "that the task can be tried anywhere"
    )


def _pose_problem(task: Task, case: Case, fold: int, archive: Archive) -> Problem[Any]:
    address = Address(task.name, task.version, case.problem_name, fold)
    return case.problem(Seeds(0, address), archive)


def _require_among(what: str, names: Iterable[str], known: Iterable[str]) -> None:
    unknown = sorted(set(names) - set(known))
    require(not unknown, f"{what} among {', '.join(known)}", unknown, "correct or register them")
