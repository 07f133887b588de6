"""The plan of a run directory: what its last run was asked to do.

A JSON object: ``keys`` in table order, the run's ``provenance``, what each of the ``jobs`` is, how
many ``workers`` it had or from which ``runs`` it was merged, and the user's own ``task_files``.
Earlier versions wrote the first two alone.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from mocapbench.basics.whole_files import write_text
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.task_files.task_file import TaskFile
from mocapbench.benchmark.tasks.address import Address

__all__ = [
    "PLAN",
    "PlannedJob",
    "load_plan",
    "plan_document",
    "planned_jobs",
    "planned_task_files",
    "save_plan",
]

PLAN = "plan.json"
_KINDS = {"keys": list, "provenance": dict}


class PlannedJob(NamedTuple):
    """A job as a plan knows it."""

    key: str
    fit_key: str
    address: Address
    training_key: str = ""
    """Of the fitted model that it shares; empty where it shares none."""


def plan_document(jobs: Iterable[Job | PlannedJob], **about: Any) -> dict[str, Any]:
    """Return the plan of ``jobs``, and what else is to be said of it."""
    jobs = list(jobs)
    rows = [
        {"fit_key": job.fit_key, "training_key": job.training_key, **job.address._asdict()}
        for job in jobs
    ]
    return {"keys": [job.key for job in jobs], "jobs": rows, **about}


def planned_task_files(plan: Mapping[str, Any]) -> tuple[TaskFile, ...]:
    """Return the user's own tasks in TOML, with the recordings that they found.

    Raises
    ------
    UsageError
        If one of them is damaged.
    """
    return tuple(map(TaskFile.from_plain, plan.get("task_files", ())))


def planned_jobs(plan: Mapping[str, Any]) -> list[PlannedJob]:
    """Return the jobs of a plan; none if an earlier version wrote it, which did not tell them."""
    return [
        PlannedJob(
            key,
            row["fit_key"],
            Address(**{name: row[name] for name in Address._fields}),
            row.get("training_key", ""),
        )
        for key, row in zip(plan["keys"], plan.get("jobs", ()), strict=False)
    ]


def save_plan(folder: Path, plan: Mapping[str, Any]) -> None:
    """Write a plan whole or not at all."""
    write_text(folder / PLAN, json.dumps(plan, indent=1))


def load_plan(folder: Path) -> Mapping[str, Any]:
    """Return the plan of a folder.

    Raises
    ------
    UsageError
        If there is none, or the file is damaged.
    """
    path = folder / PLAN
    try:
        plan = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise UsageError(f"{path} cannot be read ({error}); run `mocapbench run` again") from error
    if not _is_plan(plan):
        raise UsageError(f"{path} is not a plan; run `mocapbench run` again")
    return dict(plan)


def _is_plan(plan: Any) -> bool:
    if not isinstance(plan, dict):
        return False
    if any(not isinstance(plan.get(name), kind) for name, kind in _KINDS.items()):
        return False
    try:
        whole = len(planned_jobs(plan)) in {0, len(plan["keys"])}
        merged_from = [dict(run) for run in plan.get("runs", ())]
        return whole and plan.get("workers", 1) > 0 and all(merged_from)
    except (KeyError, TypeError, ValueError):
        return False
