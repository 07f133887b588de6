"""The state of a run, also of one that is going on in another process."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from mocapbench.benchmark.inspection.fit_seconds import MEASURED
from mocapbench.benchmark.inspection.work import ExpectedWork, work_of
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.plan_document import PlannedJob, planned_jobs
from mocapbench.benchmark.runs.record import Record, Status

__all__ = ["RunState", "TaskState", "run_state"]


class TaskState(NamedTuple):
    """How many jobs of a task are in which state."""

    done: int
    failed: int
    missing: int
    """Without the recordings that they need."""
    left: int
    """Without a record, running or not."""

    @property
    def planned(self) -> int:
        """All of them."""
        return sum(self)


_NONE = TaskState(0, 0, 0, 0)


@dataclass(frozen=True)
class RunState:
    """The state of a run.

    Parameters
    ----------
    tasks : mapping of str to TaskState
        In table order.
    writing : bool
        Whether a run is writing to the folder now.
    about : mapping of str to str
        The run's provenance.
    work_left : ExpectedWork
        The fits of jobs that are left.
    workers : int
        How many jobs run at once.
    damaged : tuple of str
        Files that are not whole.
    """

    tasks: Mapping[str, TaskState]
    writing: bool
    about: Mapping[str, str]
    work_left: ExpectedWork
    workers: int
    damaged: tuple[str, ...]

    @property
    def total(self) -> TaskState:
        """All tasks together."""
        return TaskState(*map(sum, zip(_NONE, *self.tasks.values(), strict=True)))

    @property
    def name(self) -> str:
        """The state in one word."""
        if self.writing:
            return "running"
        return "interrupted" if self.total.left else "finished"


def run_state(store: RunDirectory) -> RunState:
    """Return the state of the last run of ``store``.

    Raises
    ------
    UsageError
        If no run got so far, or its plan is damaged.
    """
    writing, plan = store.is_locked, store.load_plan()
    jobs = planned_jobs(plan)
    records = {job.key: store.load(job.key) for job in jobs}
    tasks: dict[str, list[Record | None]] = defaultdict(list)
    for job in jobs:
        tasks[job.address.task].append(records[job.key])
    left = [job for job in jobs if records[job.key] is None]
    return RunState(
        {task: _count_records(several) for task, several in tasks.items()},
        writing,
        plan["provenance"],
        _work_left(left, store, plan["provenance"].get("profile", "")),
        plan.get("workers", 1),
        tuple(dict.fromkeys(store.damaged)),
    )


def _count_records(records: Iterable[Record | None]) -> TaskState:
    counts = Counter(record.status if record else None for record in records)
    failed = sum(count for status, count in counts.items() if status and status.broken)
    return TaskState(counts[Status.OK], failed, counts[Status.DATA_MISSING], counts[None])


def _work_left(left: Sequence[PlannedJob], store: RunDirectory, profile: str) -> ExpectedWork:
    """Return the fits of jobs, as a forecast of the same run tells them.

    To score predictions that are there, or that another row asks for too, takes no time beside it.
    A model that several jobs share is fitted once.
    """
    predicted = {key for key in sorted(store.fit_keys()) if store.has_fit(key)}
    new = [job for job in left if job.fit_key not in predicted]
    fits = {job.training_key or job.fit_key: job.address for job in new}
    known = profile if profile in MEASURED else "quick"  # runs that were merged have no profile
    return work_of(fits.values(), store.records(), known)
