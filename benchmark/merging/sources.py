"""The run directories that are merged, as they are read."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.key_parts import KeyEntry
from mocapbench.benchmark.runs.plan_document import (
    PlannedJob,
    plan_document,
    planned_jobs,
    planned_task_files,
)
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.task_files.task_file import TaskFile

__all__ = ["DIRECTORY", "MergeSource", "read_source"]

DIRECTORY = "run directory"
"""Under this name, the provenance of a run that was merged has its place."""


@dataclass(frozen=True)
class MergeSource:
    """A run directory and what is whole in it.

    Parameters
    ----------
    store : RunDirectory
        Its ``damaged`` names what is left out.
    records : mapping of str to Record
        By key.
    fits : tuple of str
        The keys of its predictions.
    keys : mapping of str to KeyEntry
        What keys cover.
    jobs : tuple of PlannedJob
        Its plan, in table order.
    runs : tuple of mapping of str to str
        The provenance of each run that it was merged from, or of its own one.
    task_files : tuple of TaskFile
        The user's own tasks in TOML.
    """

    store: RunDirectory
    records: Mapping[str, Record]
    fits: tuple[str, ...]
    keys: Mapping[str, KeyEntry]
    jobs: tuple[PlannedJob, ...]
    runs: tuple[Mapping[str, str], ...]
    task_files: tuple[TaskFile, ...]


def read_source(path: Path) -> MergeSource:
    """Return what is whole in the run directory ``path``.

    Raises
    ------
    UsageError
        If it is not a run directory.
    """
    store = RunDirectory(path)
    records = {record.key: record for record in store.records()}
    fits = tuple(key for key in sorted(store.fit_keys()) if store.load_fit(key) is not None)
    plan = _plan(store, records.values())
    runs = plan.get("runs", ()) or ({DIRECTORY: str(path), **plan["provenance"]},)
    about = tuple({name: str(value) for name, value in run.items()} for run in runs)
    jobs, task_files = tuple(planned_jobs(plan)), planned_task_files(plan)
    return MergeSource(store, records, fits, store.load_keys(), jobs, about, task_files)


def _plan(store: RunDirectory, records: Iterable[Record]) -> Mapping[str, Any]:
    """Return the plan; where it is damaged, one of all records."""
    try:
        return store.load_plan()
    except UsageError as error:
        store.damaged.append(f"{error}; until then, all its records count as planned")
        in_order = sorted(records, key=lambda record: record.address)
        jobs = (PlannedJob(r.key, r.fit_key, r.address, training_key="") for r in in_order)
        return plan_document(jobs, provenance={})
