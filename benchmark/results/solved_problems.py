"""A problem posed again, with its stored solutions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isfinite, nan
from typing import Any

from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.messages import reason
from mocapbench.benchmark.problems.arrays import Arrays
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.results.interpolations import interpolates
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.tasks.base import Case, Task
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive
from mocapbench.reports import TaskLayout

__all__ = ["solved_problem"]

_UNRANKED = (TaskLayout.oracle, TaskLayout.control, TaskLayout.replay)


def solved_problem(
    task: Task, records: Sequence[Record], store: RunDirectory, archive: Archive
) -> Solved[Any, Any] | None:
    """Return the problem of one case and fold with the stored solutions of some entrants.

    None if no solution is stored, or a recording has changed since.

    Parameters
    ----------
    task : Task
    records : sequence of Record
        Of one case and fold of the task.
    store : RunDirectory
    archive : Archive

    Raises
    ------
    RecordingUnavailable, FormatError
        If a recording of the case is not at hand or cannot be read.
    """
    fits = {record.address.label: store.load_fit(record.fit_key) for record in records}
    arrays = {label: fit.arrays for label, fit in fits.items() if fit is not None}
    if not arrays:
        return None
    case = task.case(records[0].address.case)
    address = records[0].address._replace(case=case.problem_name)
    if not _has_same_recordings(case, records[0], archive):
        return None
    problem = case.problem(Seeds(records[0].seed, address), archive)
    solutions = {
        label: solution
        for label, stored in arrays.items()
        for solution in _read_solution(problem, stored, label, store)
    }
    if not solutions:
        return None
    return Solved(
        task.name,
        problem,
        solutions,
        {label: arrays[label] for label in solutions},
        task.page.published_models,
        ranking=_ranking(task, records),
        metric=METRICS.get(task.page.metrics[0]).title,
        interpolations=[r.address.label for r in records if interpolates(r.model)],
        archive=archive,
    )


def _read_solution(
    problem: Problem[Any], arrays: Arrays, label: str, store: RunDirectory
) -> Iterator[Any]:
    """Yield the solution in stored arrays; if they are none, the store says so of its damage."""
    try:
        solution = problem.from_arrays(arrays)
        problem.outcome(solution)  # which refuses what solves another problem
    except (ValueError, LookupError, TypeError, AttributeError) as error:
        store.damaged.append(f"predictions of {label}: {reason(error)}")
    else:
        yield solution


def _ranking(task: Task, records: Sequence[Record]) -> tuple[str, ...]:
    """Return the labels that compete and have the task's first metric, best first."""
    name = task.page.metrics[0]
    metric = METRICS.get(name)
    scores = {record.address.label: record.scores.get(name, nan) for record in records}
    competing = [k for k, score in scores.items() if isfinite(score) and k not in _UNRANKED]
    return tuple(sorted(competing, key=lambda k: metric.direction.loss(scores[k], metric.target)))


def _has_same_recordings(case: Case, record: Record, archive: Archive) -> bool:
    """Return whether the recordings of a case are those that the record is of."""
    digests = {uri: archive.digest(uri) for uri in case.recordings_in(record.address.fold or 0)}
    kept = {uri: record.provenance.get(f"digest of {uri}", now) for uri, now in digests.items()}
    return kept == digests
