"""The illustrations of a run: made when the report is, from stored solutions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from mocapbench.benchmark.figures.coregionalisation import coregionalisation_sketch
from mocapbench.benchmark.figures.gap_error import gap_sketch
from mocapbench.benchmark.figures.latent_space import latent_sketch
from mocapbench.benchmark.figures.sketches import sketch
from mocapbench.benchmark.figures.trend import trend_sketch
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.runs.store import Store
from mocapbench.benchmark.tasks.base import Task
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, RecordingUnavailable
from mocapbench.reports import Picture

__all__ = ["illustrations"]

SKETCHES = (sketch, gap_sketch, trend_sketch, coregionalisation_sketch, latent_sketch)


def illustrations(records: Sequence[Record], store: Store, archive: Archive) -> tuple[Picture, ...]:
    """Return the figures of every task: of the first case that it names and that has solutions.

    The problem is posed again, which takes its recordings; a case that lacks them is not shown.
    """
    tasks = [TASKS.get(name) for name in dict.fromkeys(record.task for record in records)]
    return tuple(
        illustration
        for task in tasks
        for illustration in _illustrate(task, _chosen(task, records), store, archive)
    )


def _chosen(task: Task, records: Sequence[Record]) -> list[Record]:
    """Return the records of the case to show, at the first fold that has any."""
    done = [record for record in records if record.task == task.name and record.status is Status.OK]
    ran = {record.case for record in done}
    case = next((name for name in task.illustrated if name in ran), None)
    found = [record for record in done if record.case == case]
    return [record for record in found if record.fold == min(each.fold for each in found)]


def _illustrate(
    task: Task, records: Sequence[Record], store: Store, archive: Archive
) -> Sequence[Picture]:
    fits = {record.label: store.load_fit(record.fit_key) for record in records}
    solutions = {label: fit.solution for label, fit in fits.items() if fit is not None}
    if not solutions:
        return ()
    about, case = records[0], task.case(records[0].case)
    seeds = Seeds(about.seed, task.name, task.version, case.asked, about.fold)
    try:
        problem = task.problem(case, seeds, archive)
    except RecordingUnavailable:
        return ()
    suffix = " (synthetic)" if case.synthetic else ""
    return [
        replace(each, title=f"{each.title}: {case.asked}{suffix}")
        for draw in SKETCHES
        for each in draw(problem, task, solutions)
    ]
