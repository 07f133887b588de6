"""Why each job of a plan runs or is skipped, and what is new in its key, part by part."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import chain
from pathlib import Path

from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.runs.key_parts import DIGEST
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address

__all__ = ["Changes", "Explanation", "Step", "changes", "explain", "in_words"]

_KINDS = ("metric", "parameter", "recording", "reference recording")
"""Of which a key may have many."""
_MANY = 3
"""Changes of one kind beyond which they are counted."""


Changes = Mapping[str, tuple[str, str]]
"""The parts of a key that are not as they were: before and after, empty where there is none."""


def changes(before: Mapping[str, str], after: Mapping[str, str]) -> Changes:
    """Return what differs between the parts of two keys, by name."""
    return {
        name: (before.get(name, ""), after.get(name, ""))
        for name in {**before, **after}
        if before.get(name) != after.get(name)
    }


def in_words(changed: Changes) -> str:
    """Return changes in words; many alike are counted."""
    alike: dict[tuple[str, str], list[str]] = defaultdict(list)
    for part, values in changed.items():
        alike[_kind(part), _verb(*values)].append(_describe_change(part, *values))
    texts = (
        [f"{len(group)} {kind}s{verb}"] if len(group) > _MANY else group
        for (kind, verb), group in alike.items()
    )
    return ", ".join(chain.from_iterable(texts))


def _kind(part: str) -> str:
    """Return of what kind a part is: the part of one metric is called ``metric NAME``."""
    return next((kind for kind in _KINDS if part.startswith(f"{kind} ")), part)


def _verb(before: str, after: str) -> str:
    """Return what happened to a part, unless its value is all that changed."""
    if before and after:
        return ""
    return " added" if after else " left out"


def _describe_change(part: str, before: str, after: str) -> str:
    values = [value for value in (before, after) if value]
    shown = "" if any(value.startswith(DIGEST) for value in values) else f" {' → '.join(values)}"
    return f"{part}{_verb(before, after)}{shown}"


_Parts = Mapping[Hashable, Sequence[Mapping[str, str]]]
"""The parts of the keys of records, by row: an address without the task's version."""


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
    changes : mapping of str to (str, str)
        What is new in its key, if the run directory has a record of the same row.
    """

    address: Address
    step: Step
    cause: str
    changes: Changes = field(default_factory=dict)


def explain(jobs: Sequence[Job], out: Path) -> list[Explanation]:
    """Return an explanation for each job, in their order.

    Parameters
    ----------
    jobs : sequence of Job
    out : Path
        The run directory, which need not be there.
    """
    if not RunDirectory.is_run(out):
        return list(_first(jobs))
    store = RunDirectory(out)
    earlier = _earlier_parts(store)
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


def _explain_job(job: Job, store: RunDirectory, earlier: _Parts, there: set[str]) -> Explanation:
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
    several = [changes(parts, job.parts) for parts in earlier.get(_row(job.address), ())]
    if several:
        nearest = min(several, key=len)
        return Explanation(job.address, step, "new since its last record", nearest)
    return Explanation(job.address, step, "no record yet")


def _earlier_parts(store: RunDirectory) -> _Parts:
    """Return what the keys of the records of earlier runs cover."""
    written = store.record_keys()
    found: dict[Hashable, list[Mapping[str, str]]] = defaultdict(list)
    for key, (address, parts) in store.load_keys().items():
        if key in written:
            found[_row(address)].append(parts)
    return found


def _row(address: Address) -> Address:
    return address._replace(version=0)
