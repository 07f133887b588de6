"""What the last run into a folder had, and a new one there has not: its report will not show it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from mocapbench.basics.words import format_count
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.runs.plan_document import planned_jobs
from mocapbench.benchmark.tasks.address import Address

__all__ = ["left_out_lines"]


def left_out_lines(store: RunDirectory, planned: Sequence[Job]) -> list[str]:
    """Return in words which results of the run before the report will leave out; none if none.

    Parameters
    ----------
    store : RunDirectory
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
    gone = before - now
    if not gone:
        return []
    return [
        f"not in the report: {format_count(len(gone), 'result')} of the run before "
        f"({'; '.join(_name_missing(gone, now))}), kept in {store.path} for a run that has them too"
    ]


def _name_missing(gone: Iterable[Address], now: Iterable[Address]) -> Iterator[str]:
    """Yield which models, tasks and cases are gone, and how many results are of other folds."""
    rest, kept = list(gone), list(now)
    for kind, name in (("label", "model"), ("task", "task"), ("case", "case")):
        there = {getattr(address, kind) for address in kept}
        names = sorted({getattr(address, kind) for address in rest} - there)
        if names:
            yield f"{name}{'s' if len(names) > 1 else ''} {', '.join(names)}"
        rest = [address for address in rest if getattr(address, kind) in there]
    if rest:
        yield format_count(len(rest), "other")
