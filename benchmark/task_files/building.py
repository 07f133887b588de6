"""From a task file to the task: pure, so that a worker or a report builds the same one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from functools import partial
from itertools import product
from pathlib import PurePosixPath

from mocapbench.benchmark.figures.gap_error import draw_gap_error
from mocapbench.benchmark.figures.longest_gaps import draw_longest_gaps
from mocapbench.benchmark.figures.motions.filled import draw_filled_motion
from mocapbench.benchmark.registry import MODELS, TASKS, build_unfitted
from mocapbench.benchmark.task_files.document import Document
from mocapbench.benchmark.task_files.hidden_settings import Hidden, read_hidden
from mocapbench.benchmark.task_files.library import address_of
from mocapbench.benchmark.task_files.own_problem import own_problem
from mocapbench.benchmark.task_files.settings import Settings, read_settings
from mocapbench.benchmark.task_files.task_file import TaskFile
from mocapbench.benchmark.tasks.base import PROFILES, Case, Entrant, Profile, Task
from mocapbench.datasets import subject_of
from mocapbench.reports import TaskPage

__all__ = ["add_tasks", "build_task"]


def add_tasks(files: Iterable[TaskFile]) -> tuple[str, ...]:
    """Register the tasks of task files, and return their names."""
    tasks = [build_task(file) for file in files]
    for task in tasks:
        TASKS.add(task.name, task)
    return tuple(task.name for task in tasks)


def build_task(file: TaskFile) -> Task:
    """Return the task of a task file: a case for each recording and each variant of the gaps.

    Raises
    ------
    TaskFileError
        If the file does not say what a task needs.
    """
    document = file.document
    settings = read_settings(document)
    hidden = read_hidden(document, partial(address_of, rate=settings.rate))
    whole_frames = hidden.whole_frames and file.complete
    cases = _cases(file, settings, hidden)
    _check_folds(document, settings, hidden)
    profile = Profile(
        tuple(case.name for case in cases), settings.folds, opt_in=_not_chosen(settings)
    )
    task = Task(
        name=settings.name,
        version=1,
        page=_page(settings, cases, hidden),
        requires={"fills frames" if whole_frames else "fills entries"},
        cases=cases,
        profiles=dict.fromkeys(PROFILES, profile),
        # Models without their calibration are no entrants unless they are named.
        entrants=tuple(Entrant(n, n) for n in settings.models if n not in MODELS.names()),
        meets=frozenset(file.meets),
        max_folds=1 if hidden.repeats else None,
        independent_folds=not (hidden.repeats or hidden.pattern),
    )
    _check_models(document, settings, task)
    return task


def _cases(file: TaskFile, settings: Settings, hidden: Hidden) -> tuple[Case, ...]:
    address = partial(address_of, rate=settings.rate)
    names, subjects = _names(file.tests), _subjects(file.tests)
    cases = []
    for test, (name, columns, hide) in product(file.tests, hidden.variants):
        uris = address(test), *(address(path) for path in file.training if path != test)
        patterns = (address(hidden.pattern),) if hidden.pattern else ()
        case = Case(
            f"{names[test]} {name}" if name else names[test],
            partial(own_problem, settings.select, hide, uris),
            {"recording": names[test], **columns},
            tuple(dict.fromkeys((*uris, *patterns))),
            subjects=subjects[test],
        )
        cases.append(case)
    return tuple(cases)


def _names(paths: tuple[str, ...]) -> dict[str, str]:
    """Return what to call recordings: their paths, without the suffix where they stay distinct."""
    short = {path: str(PurePosixPath(path).with_suffix("")) for path in paths}
    twice = {name for name, count in Counter([*short.values(), *paths]).items() if count > 1}
    return {path: path if name in twice else name for path, name in short.items()}


def _subjects(paths: tuple[str, ...]) -> dict[str, tuple[str, ...]]:
    """Return whose recordings they are: CMU's subject where a file has its name, else unknown.

    Of an unknown subject each recording counts for itself. All cases and folds of one recording
    are draws on it, and have no subject.
    """
    if len(paths) == 1:
        return {paths[0]: ()}
    return {path: (_subject(path),) for path in paths}


def _subject(path: str) -> str:
    try:
        return subject_of(PurePosixPath(path).stem)
    except ValueError:
        return path


def _check_folds(document: Document, settings: Settings, hidden: Hidden) -> None:
    if hidden.repeats and settings.folds > 1:
        raise document.error(
            "folds",
            "1, as hide.frames and hide.channels hide the same in every fold",
            settings.folds,
            "write folds = 1, or hide a fraction or runs",
        )


def _check_models(document: Document, settings: Settings, task: Task) -> None:
    able = [name for name in MODELS.names() if task.accepts(build_unfitted(name))]
    for name in settings.models:
        if not task.accepts(build_unfitted(name)):
            raise document.error(
                "models",
                "models that can fill what is hidden here",
                _describe_refused(name, task),
                f"choose from {', '.join(able)}",
            )


def _describe_refused(name: str, task: Task) -> str:
    unmet = task.list_unmet(build_unfitted(name)) if name in MODELS.names() else []
    return f"{name!r}{', which needs ' if unmet else ''}{' and '.join(unmet)}"


def _not_chosen(settings: Settings) -> tuple[str, ...]:
    return tuple(n for n in MODELS.names() if settings.models and n not in settings.models)


def _page(settings: Settings, cases: tuple[Case, ...], hidden: Hidden) -> TaskPage:
    columns, most = [*hidden.variants[0][1]], hidden.variants[-1][1]
    return TaskPage(
        title=settings.title,
        reference="a task file of your own",
        description=settings.description,
        question=_question(hidden),
        metrics=settings.metrics,
        along=tuple(columns[:1]),
        illustrated=tuple(case.name for case in cases if case.columns.items() >= most.items()),
        figures=(
            draw_filled_motion,
            draw_longest_gaps,
            *((draw_gap_error,) if hidden.whole_frames else ()),
        ),
    )


def _question(hidden: Hidden) -> str:
    if hidden.whole_frames:
        return "hidden-frames"
    return "scattered-samples" if hidden.scattered else "other-channels"
