"""Planning: from what the user asks for to the jobs that answer it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from mocapbench.benchmark.consistency import require_consistent
from mocapbench.benchmark.errors import UnknownNameError, UnregisteredNameError, UsageError
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.benchmark.runs.case_names import matching_cases
from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.runs.key_parts import key_parts
from mocapbench.benchmark.runs.keys import (
    fit_contents,
    key_of,
    metric_contents,
    score_contents,
    training_contents,
)
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import PROFILES, Case, Entrant, Profile, Task
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive

__all__ = ["Request", "entrants", "plan", "required_sources"]

_MISSING = "missing"


@dataclass(frozen=True)
class Request:
    """What to run; an empty tuple or None leaves the choice to the profile.

    Parameters
    ----------
    profile : str
        ``smoke``, ``quick`` or ``paper``.
    tasks, models, cases, metrics : tuple of str
        Names. A model is an entrant's label or, where a task has no such label, the model of all
        entrants that have it; a case is what ``matching_cases`` finds.
    folds : int or None
        How many folds of each case.
    seed : int
        The root seed.
    """

    profile: str = "quick"
    tasks: tuple[str, ...] = ()
    models: tuple[str, ...] = ()
    cases: tuple[str, ...] = ()
    metrics: tuple[str, ...] = ()
    folds: int | None = None
    seed: int = 0


def plan(request: Request, archive: Archive) -> tuple[Job, ...]:
    """Return the jobs of ``request`` in table order: task, case, entrant, fold.

    Raises
    ------
    UnknownNameError
        If a task, model, case, metric or profile does not exist.
    UsageError
        If a task does not have so many folds, or is not consistent (``require_consistent``).
    DigestMismatch
        If a recording is here but is not the registered one.
    """
    return tuple(
        job
        for task in _consistent_tasks(request)
        for case in _cases(request, task)
        for job in _case_jobs(request, task, case, archive)
    )


def required_sources(request: Request, archive: Archive) -> tuple[str, ...]:
    """Return the addresses of every recording that ``request`` needs, each once.

    Raises
    ------
    UnknownNameError, UsageError
        As `plan` does; and if ``archive`` has no library for an address.
    """
    tasks = [task for task in _consistent_tasks(request) if _chosen_entrants(request, task)]
    cases = [(task, case) for task in tasks for case in _cases(request, task)]
    for task, case in cases:
        _missing(task, case, archive)
    return tuple(dict.fromkeys(uri for _, case in cases for uri in case.recordings))


def entrants(task: Task) -> tuple[Entrant, ...]:
    """Return the task's entrants and, with defaults, every other registered model it accepts."""
    configured = {entrant.model for entrant in task.entrants}
    others = (Entrant(name, name) for name in MODELS.names() if name not in configured)
    return tuple(e for e in (*task.entrants, *others) if task.accepts(MODELS.get(e.model)))


def _check_names(request: Request) -> None:
    if request.profile not in PROFILES:
        raise UnknownNameError("profile", request.profile, PROFILES)
    for name in request.tasks:
        TASKS.get(name)
    for name in request.metrics:
        METRICS.current_name(name)
    tasks = _tasks(request)
    labels = {entrant.label for task in tasks for entrant in task.entrants}
    known = {*MODELS.names(), *labels}
    for name in request.models:
        if name not in known:
            raise UnregisteredNameError(MODELS.kind, name, sorted(known))
    for wanted in request.cases:
        if not matching_cases(wanted, _case_names(request)):
            raise UnknownNameError("case", wanted, _case_names(request))


def _consistent_tasks(request: Request) -> list[Task]:
    """Return the tasks of a request, once its names and they themselves are known to be right."""
    _check_names(request)
    for task in _tasks(request):
        require_consistent(task)
    return _tasks(request)


def _tasks(request: Request) -> list[Task]:
    if request.tasks:
        return [TASKS.get(name) for name in dict.fromkeys(request.tasks)]
    every = (TASKS.get(name) for name in TASKS.names())
    return [task for task in every if request.profile in task.profiles]


def _cases(request: Request, task: Task) -> Iterator[Case]:
    """Yield the profile's cases, or among all those of the task the ones asked for."""
    if not request.cases:
        yield from map(task.case, task.profile(request.profile).cases)
    names = _case_names(request)
    chosen = {name for wanted in request.cases for name in matching_cases(wanted, names)}
    yield from (case for case in task.cases if case.name in chosen)


def _case_names(request: Request) -> tuple[str, ...]:
    names = (case.name for task in _tasks(request) for case in task.cases)
    return tuple(dict.fromkeys(names))


def _chosen_entrants(request: Request, task: Task) -> list[Entrant]:
    if request.models:
        labels = {entrant.label for entrant in entrants(task)} & set(request.models)
        models = set(request.models) - labels
        return [e for e in entrants(task) if e.label in labels or e.model in models]
    left_out = task.profile(request.profile).opt_in
    return [e for e in entrants(task) if e.label not in left_out]


def _folds(request: Request, task: Task) -> int:
    folds = task.profile(request.profile).folds if request.folds is None else request.folds
    if task.max_folds is not None and folds > task.max_folds:
        raise UsageError(
            f"--folds: {task.name} has {task.max_folds} folds, got {folds}; ask for fewer, or "
            "leave it out with --tasks"
        )
    return folds


def _parameters(entrant: Entrant, case: Case, profile: Profile) -> dict[str, Any]:
    """Return the model's full parameters, its seed apart, which the label decides."""
    model = MODELS.get(entrant.model)(**entrant.parameters)
    names = model.get_params()
    prescribed = {**profile.budget, **case.parameters}
    model.set_params(**{name: v for name, v in prescribed.items() if name in names})
    parameters = {name: v for name, v in model.get_params().items() if name != "random_state"}
    for name, value in parameters.items():
        _check_plain(entrant, name, value)
    return parameters


def _check_plain(entrant: Entrant, name: str, value: object) -> None:
    """Refuse what has no stable text, and so could be in no key or record."""
    try:
        json.dumps(value)
    except (TypeError, ValueError) as error:
        raise UsageError(
            f"model {entrant.model!r}: expected parameters that JSON can hold (numbers, text, "
            f"lists of them), got {name}={value!r}; build objects from them in fit"
        ) from error


def _missing(task: Task, case: Case, archive: Archive) -> tuple[str, ...]:
    try:
        return tuple(uri for uri in case.recordings if not archive.available(uri))
    except ValueError as error:  # no such library, or a malformed address
        raise UsageError(f"task {task.name!r}, case {case.name!r}: {error}") from error


def _case_jobs(request: Request, task: Task, case: Case, archive: Archive) -> Iterator[Job]:
    missing = _missing(task, case, archive)
    digests = {uri: _MISSING if uri in missing else archive.digest(uri) for uri in case.recordings}
    seen, compared = ({uri: digests[uri] for uri in of} for of in (case.sources, case.references))
    metrics = tuple(sorted(set(map(METRICS.current_name, request.metrics or METRICS.names()))))
    scored_by = metric_contents(map(METRICS.get, metrics))
    for entrant in _chosen_entrants(request, task):
        model = MODELS.get(entrant.model)
        parameters = _parameters(entrant, case, task.profile(request.profile))
        for fold in range(_folds(request, task)):
            address = Address(task.name, task.version, case.name, fold, entrant.label)
            seeds = Seeds(request.seed, address._replace(case=case.problem_name))
            fitted = fit_contents(case, seeds, model=model, parameters=parameters, digests=seen)
            fit, learnt = key_of(fitted), seeds.of_training(case.training)
            scored = score_contents(fit, scored_by, case.name, compared)
            yield Job(
                address,
                seeds,
                learnt,
                entrant.model,
                parameters,
                metrics,
                key_of(scored),
                fit,
                key_of(training_contents(fitted, learnt)) if case.training else "",
                digests,
                missing,
                key_parts(fitted, scored),
            )
