"""Planning: from what the user asks for to the jobs that answer it."""

from __future__ import annotations

from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.runs.planning.case_jobs import case_jobs, missing_recordings
from mocapbench.benchmark.runs.planning.request import Request
from mocapbench.benchmark.runs.planning.selection import (
    chosen_cases,
    chosen_entrants,
    consistent_tasks,
)
from mocapbench.datasets import Archive

__all__ = ["plan", "required_sources"]


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
        for task in consistent_tasks(request)
        for case in chosen_cases(request, task)
        for job in case_jobs(request, task, case, archive)
    )


def required_sources(request: Request, archive: Archive) -> tuple[str, ...]:
    """Return the addresses of every recording that ``request`` needs, each once.

    Raises
    ------
    UnknownNameError, UsageError
        As `plan` does; and if ``archive`` has no library for an address.
    """
    tasks = [task for task in consistent_tasks(request) if chosen_entrants(request, task)]
    cases = [(task, case) for task in tasks for case in chosen_cases(request, task)]
    for task, case in cases:
        missing_recordings(task, case, archive)
    return tuple(dict.fromkeys(uri for _, case in cases for uri in case.recordings))
