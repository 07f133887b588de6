"""What the last run into a folder had, and a new one there has not: its report will not show it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.directory.plan_file import planned_jobs
from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.runs.store import Store
from mocapbench.benchmark.tasks.address import Address
from mocapbench.reports import counted

__all__ = ["left_out_lines"]


def left_out_lines(store: Store, planned: Sequence[Job]) -> list[str]:
    """Return in words which results the report will leave out; none if it shows all.

    Parameters
    ----------
    store : Store
        Before the plan of the new run is written.
    planned : sequence of Job
        The new run.
    """
    try:
        jobs = planned_jobs(store.load_plan())
    except UsageError:  # no run got so far
        return []
    written = store.record_keys()
    before = {job.address._replace(version=0) for job in jobs if job.key in written}
    now = {job.address._replace(version=0) for job in planned}
    if not before - now:
        return []
    return [
        f"not in the report: {counted(len(before - now), 'job')} of the run before this one "
        f"({'; '.join(_gone(before, now))}); they stay in {store.path}, and a run with these too "
        "shows them again"
    ]


def _gone(before: Iterable[Address], now: Iterable[Address]) -> Iterator[str]:
    """Yield which names are gone, by kind; if none is, single jobs are."""
    gone = {
        kind: sorted({getattr(a, kind) for a in before} - {getattr(a, kind) for a in now})
        for kind in ("label", "task", "case")
    }
    if gone["label"]:
        yield f"models {', '.join(gone['label'])}"
    if gone["task"]:
        yield f"tasks {', '.join(gone['task'])}"
    if not gone["label"] and not gone["task"]:
        yield f"cases {', '.join(gone['case'])}" if gone["case"] else "some of their folds"
