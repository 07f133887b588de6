"""Why each job of a plan runs or is skipped, in view of what the run directory holds."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from mocapbench.benchmark.inspection.changes import Change, changes
from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.runs.store import Store
from mocapbench.benchmark.tasks.address import Address

__all__ = ["Explanation", "Step", "explain"]

UNEXPLAINED = "its record was written by an earlier version, which did not keep the reasons"


class Step(StrEnum):
    """What becomes of a job."""

    SKIP = "skip"
    FIT = "fit and score"
    PREDICT = "predict by a shared fit and score"
    SCORE = "score alone"
    CANNOT = "cannot run"


@dataclass(frozen=True)
class Explanation:
    """What becomes of a job and why.

    Parameters
    ----------
    address : Address
    step : Step
    cause : str
        In words.
    changes : tuple of Change
        What is new in its key, if the run directory has a record of the same row.
    """

    address: Address
    step: Step
    cause: str
    changes: tuple[Change, ...] = ()


def explain(jobs: Sequence[Job], out: Path) -> list[Explanation]:
    """Return an explanation for each job, in their order.

    Parameters
    ----------
    jobs : sequence of Job
    out : Path
        The run directory, which need not be there.
    """
    if not Store.is_run(out):
        return list(_first(jobs))
    store = Store(out)
    earlier = _Earlier(store)
    there = {key for key in {job.fit_key for job in jobs} if store.has_fit(key)}
    explanations = []
    for job in jobs:
        explanation = _explain_job(job, store, earlier, there)
        explanations.append(explanation)
        there |= _left_by(job, explanation.step)
    return explanations


def _first(jobs: Sequence[Job]) -> Iterator[Explanation]:
    """Yield what becomes of the jobs of a first run."""
    there: set[str] = set()
    for job in jobs:
        step = _step(job, there)
        yield Explanation(job.address, step, "no record yet")
        there |= _left_by(job, step)


def _left_by(job: Job, step: Step) -> set[str]:
    """Return the keys of what is there by the time when the next job runs."""
    fitted = {job.training_key} - {""} if step is Step.FIT else set()
    return {job.fit_key, *fitted}


def _step(job: Job, there: set[str]) -> Step:
    if job.missing:
        return Step.CANNOT
    if job.fit_key in there:
        return Step.SCORE
    return Step.PREDICT if job.training_key in there else Step.FIT


def _explain_job(job: Job, store: Store, earlier: _Earlier, there: set[str]) -> Explanation:
    step, record = _step(job, there), store.load(job.key)
    match record:
        case Record(status=Status.DATA_MISSING):
            return Explanation(job.address, Step.SKIP, "its recordings are still missing")
        case Record(status=status) if not status.broken:
            return Explanation(job.address, Step.SKIP, "done")
        case Record(status=status):
            return Explanation(job.address, step, f"tried again, since it ended as: {status}")
    if store.record_path(job.key).is_file():
        return Explanation(job.address, step, "its record is damaged")
    return Explanation(job.address, step, *earlier.compare(job))


class _Earlier:
    """The records of earlier runs by row, which is an address without the task's version."""

    def __init__(self, store: Store) -> None:
        self._store = store
        written = store.record_keys()
        known = {key: entry for key, entry in store.load_keys().items() if key in written}
        self._parts: dict[Hashable, list[Mapping[str, str]]] = defaultdict(list)
        for entry in known.values():
            self._parts[_row(entry.address)].append(entry.parts)
        self._without_parts = self._rows_of(written - known.keys())

    def _rows_of(self, keys: set[str]) -> set[Hashable]:
        """Return the rows of records whose parts were not kept."""
        records = (self._store.load(key) for key in keys)
        return {_row(record.address) for record in records if record}

    def compare(self, job: Job) -> tuple[str, tuple[Change, ...]]:
        """Return why a job that has no record runs, beside the record most like it."""
        row = _row(job.address)
        several = [changes(parts, job.parts) for parts in self._parts.get(row, ())]
        if several:
            return "new since its last record", min(several, key=len)
        if row in self._without_parts:
            return UNEXPLAINED, ()
        return "no record yet", ()


def _row(address: Address) -> Address:
    return address._replace(version=0)
