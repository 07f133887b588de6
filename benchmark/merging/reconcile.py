"""Reconciling run directories: what is whole in each, which record is kept, and the plan of all."""

from __future__ import annotations

import hashlib
from collections import defaultdict
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.inspection.explanation import changes, in_words
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.key_parts import KeyEntry
from mocapbench.benchmark.runs.plan_document import (
    PlannedJob,
    plan_document,
    planned_jobs,
    planned_task_files,
)
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.task_files.task_file import TaskFile
from mocapbench.benchmark.task_files.uniting import united_task_files

__all__ = [
    "DIRECTORY",
    "Found",
    "MergedRun",
    "read_merged_run",
    "unite_fits",
    "unite_plans",
    "unite_records",
]

DIRECTORY = "run directory"
"""Under this name, the provenance of a run that was merged has its place."""


@dataclass(frozen=True)
class MergedRun:
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


def read_merged_run(path: Path) -> MergedRun:
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
    return MergedRun(store, records, fits, store.load_keys(), jobs, about, task_files)


def _plan(store: RunDirectory, records: Iterable[Record]) -> Mapping[str, Any]:
    """Return the plan; where it is damaged, one of all records."""
    try:
        return store.load_plan()
    except UsageError as error:
        store.damaged.append(f"{error}; until then, all its records count as planned")
        in_order = sorted(records, key=lambda record: record.address)
        jobs = (PlannedJob(r.key, r.fit_key, r.address, training_key="") for r in in_order)
        return plan_document(jobs, provenance={})


_SHOWN = 10
"""Differences, of which there may be thousands."""


Found = tuple[Record, Path]
"""A record and the file that it is in."""


def unite_records(merged: Sequence[MergedRun]) -> dict[str, Found]:
    """Return one record for each key.

    A job that went well counts rather than one that broke. Which of several equal ones is taken
    does not depend on the order of the runs.

    Raises
    ------
    UsageError
        If two records of one key have different scores.
    """
    found: dict[str, list[Found]] = defaultdict(list)
    for run in merged:
        for key, record in run.records.items():
            found[key].append((record, run.store.record_path(key)))
    _check_agreement(found.values())
    return {key: min(several, key=_preference) for key, several in found.items()}


def _preference(found: Found) -> tuple[bool, str]:
    record, _ = found
    return record.status is not Status.OK, record.to_json()


def _check_agreement(several: Iterable[Sequence[Found]]) -> None:
    differences = [
        text
        for found in several
        for one, other in pairwise([item for item in found if item[0].status is Status.OK])
        for text in _differences(one, other)
    ]
    if differences:
        more = len(differences) - _SHOWN
        shown = [*differences[:_SHOWN], *([f"… and {more} more"] if more > 0 else [])]
        raise UsageError(
            "expected equal scores where two runs have computed the same job, got\n  "
            + "\n  ".join(shown)
            + "\nnothing was written; delete the records that are wrong, or compute them again"
        )


def _differences(one: Found, other: Found) -> list[str]:
    """Return in words which scores of one job differ; NaN is equal to itself."""
    (record, path), (twin, other_path) = one, other
    values, others = ({name: repr(v) for name, v in r.scores.items()} for r in (record, twin))
    return [
        f"{record.address}: {name} {values.get(name, 'none')} in {path}, "
        f"{others.get(name, 'none')} in {other_path}"
        for name in {**values, **others}
        if values.get(name) != others.get(name)
    ]


def unite_fits(merged: Sequence[MergedRun]) -> dict[str, Path]:
    """Return one file of predictions for each key, whatever the order of the runs."""
    found: dict[str, list[Path]] = defaultdict(list)
    for run in merged:
        for key in run.fits:
            found[key].append(run.store.fit_path(key))
    return {key: paths[0] if len(paths) == 1 else _first(paths) for key, paths in found.items()}


def _first(paths: Iterable[Path]) -> Path:
    return min(paths, key=lambda path: hashlib.sha256(path.read_bytes()).hexdigest())


def unite_plans(
    merged: Sequence[MergedRun], records: Mapping[str, Found], keys: Mapping[str, KeyEntry]
) -> dict[str, Any]:
    """Return the plan of all jobs of the runs.

    Of two jobs in one row of the tables, one without its recordings gives way.

    Parameters
    ----------
    merged : sequence of MergedRun
        The first one's order goes before that of what others add.
    records : mapping of str to Found
        The records that are kept, by key.
    keys : mapping of str to KeyEntry
        What keys cover.

    Raises
    ------
    UsageError
        If two runs have different jobs in one row.
    """
    rows: dict[Hashable, dict[str, PlannedJob]] = defaultdict(dict)
    for job in (job for run in merged for job in run.jobs):
        rows[job.address._replace(version=0)].setdefault(job.key, job)
    jobs = [_one(list(row.values()), records, keys) for row in rows.values()]
    runs = _distinct(run for one in merged for run in one.runs)
    task_files = united_task_files(file for run in merged for file in run.task_files)
    return plan_document(
        _in_table_order(jobs),
        provenance=_provenance(runs),
        runs=runs,
        task_files=task_files,
    )


def _one(
    row: Sequence[PlannedJob], records: Mapping[str, Found], keys: Mapping[str, KeyEntry]
) -> PlannedJob:
    """Return the job that stands in a row."""
    lacking = {
        job.key
        for job in row
        if job.key in records and records[job.key][0].status is Status.DATA_MISSING
    }
    with_data = [job for job in row if job.key not in lacking] or list(row)
    if len(with_data) > 1:
        known = [keys[job.key][1] for job in with_data[:2] if job.key in keys]
        new = in_words(changes(*known)) if len(known) == 2 else ""
        raise UsageError(
            f"expected one job in each row of the tables, got two for {row[0].address}, which "
            f"differ in {new or 'their keys'}; nothing was written: merge runs of one request "
            "and one version of the code, or bring them up to date with `mocapbench run` first"
        )
    return with_data[0]


def _in_table_order(jobs: Sequence[PlannedJob]) -> list[PlannedJob]:
    """Sort by task, case and entrant, each in the order of appearance, and by fold."""
    places: dict[Hashable, int] = {}

    def place(job: PlannedJob) -> tuple[int, ...]:
        task, _, case, fold, label = job.address
        nested = (task,), (task, case), (task, case, label)
        return (*(places.setdefault(name, len(places)) for name in nested), fold or 0)

    ranked = [(place(job), job) for job in jobs]  # all places, before any are compared
    return [job for _, job in sorted(ranked, key=lambda pair: pair[0])]


def _distinct(runs: Iterable[Mapping[str, str]]) -> list[Mapping[str, str]]:
    return list({tuple(sorted(run.items())): run for run in runs}.values())


def _provenance(runs: Sequence[Mapping[str, str]]) -> dict[str, str]:
    """Return what the runs say of themselves, side by side where they differ."""
    names = dict.fromkeys(name for run in runs for name in run if name != DIRECTORY)
    held = {name: dict.fromkeys(run[name] for run in runs if name in run) for name in names}
    merged = {"merged from": "; ".join(dict.fromkeys(run.get(DIRECTORY, "?") for run in runs))}
    return {**{name: " and ".join(values) for name, values in held.items()}, **merged}
