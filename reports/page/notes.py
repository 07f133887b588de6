"""The notes on tasks: each stands once on the page."""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.bundle.questions import question
from mocapbench.reports.paper.remarks import footnotes
from mocapbench.reports.tables.letters import letters

__all__ = ["SharedNotes", "shared_notes", "task_notes"]


@dataclass(frozen=True)
class SharedNotes:
    """Remarks that the same tasks have.

    Parameters
    ----------
    question : str
        Title of the question of the first of them, below which the page shows the remarks.
    tasks, remarks : tuple of str
        Titles of the tasks, and what is remarked on all of them.
    """

    question: str
    tasks: tuple[str, ...]
    remarks: tuple[str, ...]


def shared_notes(layouts: Sequence[TaskLayout]) -> list[SharedNotes]:
    """Return the remarks that several tasks have, in page order."""
    owners: dict[str, list[TaskLayout]] = {}
    for layout in layouts:
        for remark in dict.fromkeys(layout.page.remarks):
            owners.setdefault(remark, []).append(layout)
    groups: dict[tuple[str, ...], list[str]] = {}
    for remark, tasks in owners.items():
        if len(tasks) > 1:
            groups.setdefault(tuple(task.page.title for task in tasks), []).append(remark)
    return [
        SharedNotes(question(owners[remarks[0]][0].page.question).title, titles, tuple(remarks))
        for titles, remarks in groups.items()
    ]


def task_notes(results: TaskResults, shared: Container[str]) -> list[str]:
    """Return the remarks on a task that are not ``shared``, then the notes by their letters."""
    own = [remark for remark in results.layout.page.remarks if remark not in shared]
    return [*own, *footnotes(letters(results))]
