"""The plan of merged runs: the jobs of all in table order, and where they come from."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Iterable, Mapping, Sequence
from typing import Any

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.inspection.changes import changes, in_words
from mocapbench.benchmark.merging.records import Found
from mocapbench.benchmark.merging.sources import DIRECTORY, MergeSource
from mocapbench.benchmark.runs.key_parts import KeyEntry
from mocapbench.benchmark.runs.plan_document import PlannedJob, plan_document
from mocapbench.benchmark.runs.record import Status
from mocapbench.benchmark.task_files.uniting import united_task_files

__all__ = ["unite_plans"]


def unite_plans(
    sources: Sequence[MergeSource], records: Mapping[str, Found], keys: Mapping[str, KeyEntry]
) -> dict[str, Any]:
    """Return the plan of all jobs of ``sources``.

    Of two jobs in one row of the tables, one without its recordings gives way.

    Parameters
    ----------
    sources : sequence of MergeSource
        The first one's order goes before that of what others add.
    records : mapping of str to Found
        The records that are kept, by key.
    keys : mapping of str to KeyEntry
        What keys cover.

    Raises
    ------
    UsageError
        If two sources have different jobs in one row.
    """
    rows: dict[Hashable, dict[str, PlannedJob]] = defaultdict(dict)
    for job in (job for source in sources for job in source.jobs):
        rows[job.address._replace(version=0)].setdefault(job.key, job)
    jobs = [_one(list(row.values()), records, keys) for row in rows.values()]
    runs = _distinct(run for source in sources for run in source.runs)
    task_files = united_task_files(file for source in sources for file in source.task_files)
    return plan_document(
        _in_table_order(jobs),
        provenance=_provenance(runs),
        runs=runs,
        task_files=[file.to_plain() for file in task_files],
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
