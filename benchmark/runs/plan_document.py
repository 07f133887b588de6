"""The plan of a run directory: what its last run was asked to do.

A JSON object: ``keys`` in table order, what each of the ``jobs`` is, the run's ``provenance``, how
many ``workers`` it had or from which ``runs`` it was merged, and the user's own ``task_files``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.task_files.task_file import TaskFile
from mocapbench.benchmark.tasks.address import Address

__all__ = ["PlannedJob", "is_plan", "plan_document", "planned_jobs", "planned_task_files"]

_KINDS = {"keys": list, "jobs": list, "provenance": dict}


class PlannedJob(NamedTuple):
    """A job as a plan knows it."""

    key: str
    fit_key: str
    address: Address
    training_key: str
    """Of the fitted model that it shares; empty where it shares none."""


def plan_document(jobs: Iterable[Job | PlannedJob], **about: Any) -> dict[str, Any]:
    """Return the plan of ``jobs``, and what else is to be said of it."""
    jobs = list(jobs)
    rows = [
        {"fit_key": job.fit_key, "training_key": job.training_key, **job.address._asdict()}
        for job in jobs
    ]
    return {"keys": [job.key for job in jobs], "jobs": rows, **about}


def planned_jobs(plan: Mapping[str, Any]) -> list[PlannedJob]:
    """Return the jobs of a plan."""
    return [
        PlannedJob(
            key,
            row["fit_key"],
            Address(**{name: row[name] for name in Address._fields}),
            row["training_key"],
        )
        for key, row in zip(plan["keys"], plan["jobs"], strict=True)
    ]


def planned_task_files(plan: Mapping[str, Any]) -> tuple[TaskFile, ...]:
    """Return the user's own tasks in TOML, with the recordings that they found.

    Raises
    ------
    UsageError
        If one of them is damaged.
    """
    return tuple(map(TaskFile.from_plain, plan.get("task_files", ())))


def is_plan(document: Any) -> bool:
    """Return whether a JSON document is a plan."""
    if not isinstance(document, dict):
        return False
    if any(not isinstance(document.get(name), kind) for name, kind in _KINDS.items()):
        return False
    try:
        planned_jobs(document)
        merged_from = [dict(run) for run in document.get("runs", ())]
        return document.get("workers", 1) > 0 and all(merged_from)
    except (KeyError, TypeError, ValueError):
        return False
