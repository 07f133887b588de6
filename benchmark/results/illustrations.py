"""The illustrations of a run: made from stored solutions when the report is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache

from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.results.solved_problems import solved_problem
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.base import Task
from mocapbench.datasets import Archive, FormatError, Recording, RecordingUnavailable
from mocapbench.reports import Picture

__all__ = ["illustrations"]


def illustrations(
    records: Sequence[Record], store: RunDirectory, archive: Archive
) -> tuple[Picture, ...]:
    """Return the figures of every task: of the first case that it names and that has solutions.

    The problem is posed again, which takes its recordings; a case that lacks them, or of which one
    has changed since, is not shown.
    """
    archive = _ReadOnce(archive)
    tasks = [TASKS.get(name) for name in dict.fromkeys(r.address.task for r in records)]
    return tuple(
        picture
        for task in tasks
        for picture in _illustrate(task, _choose_records(task, records), store, archive)
    )


def _choose_records(task: Task, records: Sequence[Record]) -> list[Record]:
    """Return the records of the case to show, at the first fold that has any."""
    done = [r for r in records if r.address.task == task.name and r.status is Status.OK]
    ran = {record.address.case for record in done}
    case = next((name for name in task.page.illustrated if name in ran), None)
    of_case = [record for record in done if record.address.case == case]
    first = min((record.address.fold or 0 for record in of_case), default=0)
    return [record for record in of_case if record.address.fold == first]


def _illustrate(
    task: Task, records: Sequence[Record], store: RunDirectory, archive: Archive
) -> Sequence[Picture]:
    try:
        solved = solved_problem(task, records, store, archive)
    except (RecordingUnavailable, FormatError):
        return ()
    if solved is None:
        return ()
    case = task.case(records[0].address.case)
    suffix = " (synthetic)" if case.synthetic else ""
    return [
        replace(picture, title=f"{picture.title}: {case.problem_name}{suffix}")
        for figure in task.page.figures
        for picture in figure(solved)
    ]


class _ReadOnce(Archive):
    """An archive that reads a recording once: several tasks use the same."""

    def __init__(self, archive: Archive) -> None:
        super().__init__(archive.libraries)
        self._read = cache(archive.recording)

    def recording(self, uri: str) -> Recording:
        """Return a recording; see `Archive.recording`."""
        return self._read(uri)
