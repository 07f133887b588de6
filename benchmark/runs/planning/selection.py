"""The tasks, cases, entrants and folds that a request stands for."""

from __future__ import annotations

from collections.abc import Iterator

from mocapbench.benchmark.consistency import require_consistent
from mocapbench.benchmark.errors import UnknownNameError, UnregisteredNameError, UsageError
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.benchmark.runs.planning.case_names import matching_cases
from mocapbench.benchmark.runs.planning.request import Request
from mocapbench.benchmark.tasks.base import PROFILES, Case, Entrant, Task

__all__ = ["chosen_cases", "chosen_entrants", "chosen_folds", "consistent_tasks", "entrants"]


def entrants(task: Task) -> tuple[Entrant, ...]:
    """Return the task's entrants and, with defaults, every other registered model it accepts."""
    configured = {entrant.model for entrant in task.entrants}
    others = (Entrant(name, name) for name in MODELS.names() if name not in configured)
    return tuple(e for e in (*task.entrants, *others) if task.accepts(MODELS.get(e.model)))


def consistent_tasks(request: Request) -> list[Task]:
    """Return the tasks of a request, once its names and they themselves are known to be right.

    Raises
    ------
    UnknownNameError
        If a task, model, case, metric or profile does not exist.
    UsageError
        If a task is not consistent (``require_consistent``).
    """
    _check_names(request)
    for task in _tasks(request):
        require_consistent(task)
    return _tasks(request)


def chosen_cases(request: Request, task: Task) -> Iterator[Case]:
    """Yield the profile's cases, or among all those of the task the ones asked for."""
    if not request.cases:
        yield from map(task.case, task.profile(request.profile).cases)
    names = _case_names(request)
    chosen = {name for wanted in request.cases for name in matching_cases(wanted, names)}
    yield from (case for case in task.cases if case.name in chosen)


def chosen_entrants(request: Request, task: Task) -> list[Entrant]:
    """Return the entrants asked for, or those that the profile does not leave out."""
    if request.models:
        labels = {entrant.label for entrant in entrants(task)} & set(request.models)
        models = set(request.models) - labels
        return [e for e in entrants(task) if e.label in labels or e.model in models]
    left_out = task.profile(request.profile).opt_in
    return [e for e in entrants(task) if e.label not in left_out]


def chosen_folds(request: Request, task: Task) -> int:
    """Return how many folds of each case are asked for.

    Raises
    ------
    UsageError
        If the task does not have so many.
    """
    folds = task.profile(request.profile).folds if request.folds is None else request.folds
    if task.max_folds is not None and folds > task.max_folds:
        raise UsageError(
            f"--folds: {task.name} has {task.max_folds} folds, got {folds}; ask for fewer, or "
            "leave it out with --tasks"
        )
    return folds


def _check_names(request: Request) -> None:
    if request.profile not in PROFILES:
        raise UnknownNameError("profile", request.profile, PROFILES)
    for name in request.tasks:
        TASKS.get(name)
    for name in request.metrics:
        METRICS.get(name)
    tasks = _tasks(request)
    labels = {entrant.label for task in tasks for entrant in task.entrants}
    known = {*MODELS.names(), *labels}
    for name in request.models:
        if name not in known:
            raise UnregisteredNameError(MODELS.kind, name, sorted(known))
    for wanted in request.cases:
        if not matching_cases(wanted, _case_names(request)):
            raise UnknownNameError("case", wanted, _case_names(request))


def _tasks(request: Request) -> list[Task]:
    if request.tasks:
        return [TASKS.get(name) for name in dict.fromkeys(request.tasks)]
    every = (TASKS.get(name) for name in TASKS.names())
    return [task for task in every if request.profile in task.profiles]


def _case_names(request: Request) -> tuple[str, ...]:
    names = (case.name for task in _tasks(request) for case in task.cases)
    return tuple(dict.fromkeys(names))
