"""The state of a run, also of one that is going on in another process."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from mocapbench.benchmark.inspection.work import MEASURED, Estimate, estimate_fits
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.plan_document import PlannedJob, planned_jobs
from mocapbench.benchmark.runs.record import Record, Status

__all__ = ["RunState", "run_state"]


@dataclass(frozen=True)
class RunState:
    """The state of a run.

    Parameters
    ----------
    tasks : mapping of str to Counter
        How many jobs of each task, in table order, are ``"done"``, ``"failed"``, have
        ``"data missing"``, or are ``"left"``, running or not.
    writing : bool
        Whether a run is writing to the folder now.
    about : mapping of str to str
        The run's provenance.
    work_left : sequence of Estimate
        The fits of jobs that are left.
    workers : int
        How many jobs run at once.
    damaged : tuple of str
        Files that are not whole.
    """

    tasks: Mapping[str, Counter[str]]
    writing: bool
    about: Mapping[str, str]
    work_left: Sequence[Estimate]
    workers: int
    damaged: tuple[str, ...]

    @property
    def total(self) -> Counter[str]:
        """All tasks together."""
        return sum(self.tasks.values(), Counter())

    @property
    def name(self) -> str:
        """The state in one word."""
        if self.writing:
            return "running"
        return "interrupted" if self.total["left"] else "finished"


def run_state(store: RunDirectory) -> RunState:
    """Return the state of the last run of ``store``.

    Raises
    ------
    UsageError
        If no run got so far, or its plan is damaged.
    """
    writing, plan = store.is_locked, store.load_plan()
    jobs = planned_jobs(plan)
    states = [_name_state(store.load(job.key)) for job in jobs]  # of 100,000 no record is kept
    tasks: dict[str, Counter[str]] = defaultdict(Counter)
    for job, state in zip(jobs, states, strict=True):
        tasks[job.address.task][state] += 1
    left = [job for job, state in zip(jobs, states, strict=True) if state == "left"]
    return RunState(
        tasks,
        writing,
        plan["provenance"],
        _work_left(left, store, plan["provenance"].get("profile", "")),
        plan.get("workers", 1),
        tuple(dict.fromkeys(store.damaged)),
    )


def _name_state(record: Record | None) -> str:
    """Return the state of a job that has this record."""
    if record is None:
        return "left"
    if record.status.broken:
        return "failed"
    return "done" if record.status is Status.OK else "data missing"


def _work_left(left: Sequence[PlannedJob], store: RunDirectory, profile: str) -> list[Estimate]:
    """Return the fits of jobs, as a forecast of the same run tells them.

    To score predictions that are there, or that another row asks for too, takes no time beside it.
    A model that several jobs share is fitted once.
    """
    if not left:
        return []
    predicted = {key for key in sorted(store.fit_keys()) if store.has_fit(key)}
    new = [job for job in left if job.fit_key not in predicted]
    fits = {job.training_key or job.fit_key: job.address for job in new}
    known = profile if profile in MEASURED else "quick"  # runs that were merged have no profile
    records = filter(None, map(store.load, sorted(store.record_keys())))
    return estimate_fits(fits.values(), records, known)
