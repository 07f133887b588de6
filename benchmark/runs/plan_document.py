"""The plan of a run directory: what its last run was asked to do.

A JSON object: ``keys`` in table order, what each of the ``jobs`` is, the run's ``provenance``, how
many ``workers`` it had or from which ``runs`` it was merged, and the user's own ``task_files``. By
the ``drawn`` report, the ``basis`` and the ``recordings`` a later run knows that nothing is new.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from mocapbench.benchmark.foreign_files import (
    Count,
    ForeignFileError,
    Index,
    Key,
    KeyOrNone,
    Name,
    Text,
    list_schema,
    read_file,
    read_json,
    table_schema,
)
from mocapbench.benchmark.task_files.task_file import TaskFile
from mocapbench.benchmark.tasks.address import Address

if TYPE_CHECKING:
    from mocapbench.benchmark.runs.job import Job

__all__ = ["PlannedJob", "plan_document", "planned_jobs", "planned_task_files", "read_plan"]

_ROW = {
    "fit_key": Key,
    "training_key": KeyOrNone,
    "task": Name,
    "version": Index,
    "case": Name,
    "fold": Index | None,
    "label": Name,
}
_PLAN = table_schema(
    {"keys": list[Key], "jobs": list_schema(table_schema(_ROW)), "provenance": dict[Name, Text]},
    optional={
        "workers": Count,
        "runs": list[dict[Name, Text]],
        "task_files": list[TaskFile],
        "drawn": Name,
        "basis": Name,
        "recordings": list[Name],
    },
)
"""What the file of a plan holds."""
_LARGEST = 256 * 2**20
"""Bytes, of hundreds of thousands of jobs."""


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
    """Return the user's own tasks in TOML, with the recordings that they found."""
    return tuple(plan.get("task_files", ()))


def read_plan(path: Path) -> dict[str, Any]:
    """Return the plan in a file; its task files are those that `planned_task_files` returns.

    Raises
    ------
    ForeignFileError
        If it is damaged.
    """
    return read_file(path, "a plan", "run `mocapbench run` again", _read_whole)


def _read_whole(path: Path) -> dict[str, Any]:
    plan: dict[str, Any] = read_json(path, _PLAN, _LARGEST)
    keys, jobs = len(plan["keys"]), len(plan["jobs"])
    if keys != jobs:
        raise ForeignFileError(f"expected a key for each job, got {keys} for {jobs}")
    _require_each_once(plan)
    return plan


def _require_each_once(plan: Mapping[str, Any]) -> None:
    """Refuse a plan with two jobs of one row, whose values no table can hold."""
    counts = Counter(job.address for job in planned_jobs(plan))
    twice = next((address for address, count in counts.items() if count > 1), None)
    if twice:
        raise ForeignFileError(f"expected each job once, got {twice} twice")
