"""What a user asks to be run, and the tasks, cases, entrants and folds that it stands for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from mocapbench.benchmark.consistency import require_consistent
from mocapbench.benchmark.errors import UnknownNameError, UnregisteredNameError, UsageError
from mocapbench.benchmark.registry import (
    METRICS,
    MODELS,
    TASKS,
    UNCALIBRATED,
    build_unfitted,
    find_calibration,
)
from mocapbench.benchmark.tasks.base import PROFILES, Case, Entrant, Task

if TYPE_CHECKING:
    from mocapbench.baselines import Model

__all__ = [
    "Request",
    "chosen_cases",
    "chosen_entrants",
    "chosen_folds",
    "consistent_tasks",
    "entrants",
    "list_unmet_needs",
    "matching_cases",
    "nameable_entrants",
    "split_cases",
]


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


def entrants(task: Task) -> tuple[Entrant, ...]:
    """Return the task's entrants and, with defaults, every other registered model it accepts."""
    return tuple(e for e in _candidates(task) if task.accepts(_build_entrant(e)))


def list_unmet_needs(request: Request) -> list[str]:
    """Return what the models that a request names need and one of its tasks does not have."""
    texts = [
        f"{entrant.label} needs {' and '.join(unmet)}"
        for task in _tasks(request)
        for entrant in _candidates(task)
        if {entrant.label, entrant.model} & {*request.models}
        and (unmet := task.list_unmet(_build_entrant(entrant)))
    ]
    return list(dict.fromkeys(texts))


def nameable_entrants(task: Task) -> tuple[Entrant, ...]:
    """Return the entrants, and those without their calibration, which only take part by name."""
    listed = entrants(task)
    others = [
        Entrant(entrant.label + UNCALIBRATED, entrant.model + UNCALIBRATED, entrant.parameters)
        for entrant in listed
        if find_calibration(entrant.model)
    ]
    taken = {entrant.label for entrant in task.entrants}
    return (*listed, *(entrant for entrant in others if entrant.label not in taken))


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
        nameable = nameable_entrants(task)
        labels = {entrant.label for entrant in nameable} & set(request.models)
        models = set(request.models) - labels
        return [e for e in nameable if e.label in labels or e.model in models]
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


def _candidates(task: Task) -> tuple[Entrant, ...]:
    configured = {entrant.model for entrant in task.entrants}
    others = (Entrant(name, name) for name in MODELS.names() if name not in configured)
    return (*task.entrants, *others)


def _build_entrant(entrant: Entrant) -> Model:
    return build_unfitted(entrant.model, entrant.parameters)


def _check_names(request: Request) -> None:
    if request.profile not in PROFILES:
        raise UnknownNameError("profile", request.profile, PROFILES)
    for name in request.tasks:
        TASKS.get(name)
    for name in request.metrics:
        METRICS.get(name)
    tasks = _tasks(request)
    labels = {entrant.label for task in tasks for entrant in task.entrants}
    listed = {*MODELS.names(), *labels}
    for name in request.models:
        if name not in listed and not _is_nameable(name, tasks):
            raise UnregisteredNameError(MODELS.kind, name, sorted(listed))
    for wanted in request.cases:
        if not matching_cases(wanted, _case_names(request)):
            raise UnknownNameError("case", wanted, _case_names(request))


def _is_nameable(name: str, tasks: Iterable[Task]) -> bool:
    nameable = (entrant for task in tasks for entrant in nameable_entrants(task))
    return any(name in {entrant.label, entrant.model} for entrant in nameable)


def _tasks(request: Request) -> list[Task]:
    if request.tasks:
        return [TASKS.get(name) for name in dict.fromkeys(request.tasks)]
    every = (TASKS.get(name) for name in TASKS.names())
    return [task for task in every if request.profile in task.profiles]


def _case_names(request: Request) -> tuple[str, ...]:
    names = (case.name for task in _tasks(request) for case in task.cases)
    return tuple(dict.fromkeys(names))


def matching_cases(wanted: str, names: Iterable[str]) -> tuple[str, ...]:
    """Return the names that ``wanted`` stands for; none if it stands for none.

    They are the first of these that there are: the name itself; the names that match a pattern
    such as ``observed*``; the names that begin with it. An underscore stands for a hyphen too, so
    that ``35_03``, as CMU writes it, finds the cases on that recording.

    Parameters
    ----------
    wanted : str
    names : iterable of str
        Every name there is.

    Examples
    --------
    >>> names = ("35-03 four-walkers", "35-03 three-walkers", "test 1", "test 10")
    >>> matching_cases("35_03", names)
    ('35-03 four-walkers', '35-03 three-walkers')
    >>> matching_cases("test 1", names)
    ('test 1',)
    """
    names, typed = tuple(dict.fromkeys(names)), _hyphenate(wanted)
    ways = (
        [name for name in names if _hyphenate(name) == typed],
        [name for name in names if fnmatchcase(_hyphenate(name), typed)],
        [name for name in names if _hyphenate(name).startswith(typed)],
    )
    return tuple(next(filter(None, ways), ()))


def split_cases(text: str, names: Iterable[str]) -> Iterator[str]:
    """Yield what a user typed at commas, those apart that belong to the name of a case.

    Parameters
    ----------
    text : str
    names : iterable of str
        Every name there is.

    Examples
    --------
    >>> names = ("a limb 1 s, alone", "test 1")
    >>> list(split_cases("test 1, a limb 1 s, alone", names))
    ['test 1', 'a limb 1 s, alone']
    """
    known, parts = tuple(names), [part.strip() for part in text.split(",") if part.strip()]
    while parts:
        lengths = [
            n for n in range(len(parts), 1, -1) if matching_cases(", ".join(parts[:n]), known)
        ]
        n = next(iter(lengths), 1)
        yield ", ".join(parts[:n])
        parts = parts[n:]


def _hyphenate(name: str) -> str:
    return name.replace("_", "-")
