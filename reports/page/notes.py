"""What stands once on the page: remarks on several tasks, and recordings that jobs lack."""

from __future__ import annotations

import shlex
from collections.abc import Container, Sequence
from typing import Any

import pandas as pd

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.bundle.task_page import QUESTIONS
from mocapbench.reports.paper.remarks import footnotes
from mocapbench.reports.tables.letters import letters

__all__ = ["missing_data", "shared_notes", "task_notes"]

Part = dict[str, Any]
"""What the template reads for one part of the page, by name."""


def shared_notes(layouts: Sequence[TaskLayout]) -> list[Part]:
    """Return the remarks that several tasks have, in page order.

    Returns
    -------
    list of dict
        The titles of the ``tasks``, the ``remarks`` on all of them, and the title of the
        ``question`` of the first task, below which the page shows the remarks.
    """
    owners: dict[str, list[TaskLayout]] = {}
    for layout in layouts:
        for remark in dict.fromkeys(layout.page.remarks):
            owners.setdefault(remark, []).append(layout)
    groups: dict[tuple[str, ...], list[str]] = {}
    for remark, tasks in owners.items():
        if len(tasks) > 1:
            groups.setdefault(tuple(task.page.title for task in tasks), []).append(remark)
    return [
        {
            "question": QUESTIONS[owners[remarks[0]][0].page.question][0],
            "tasks": titles,
            "remarks": remarks,
        }
        for titles, remarks in groups.items()
    ]


def task_notes(results: TaskResults, shared: Container[str]) -> list[str]:
    """Return the remarks on a task that are not ``shared``, then the notes by their letters."""
    own = [remark for remark in results.layout.page.remarks if remark not in shared]
    return [*own, *footnotes(letters(results))]


def missing_data(jobs: pd.DataFrame) -> list[Part]:
    """Group the jobs that lack data by the command that gets them, whatever the recordings.

    Parameters
    ----------
    jobs : DataFrame
        Rows of `mocapbench.reports.analysis.results.list_failures`.

    Returns
    -------
    list of dict
        The names of the ``recordings``, none where the jobs do not name them; as ``message`` the
        command, or what the jobs say; the ``tasks`` concerned, and the number of ``jobs``.
    """
    starts = jobs["fetch"].where(jobs["fetch"] != "", jobs["message"])
    return [
        {
            "recordings": (recordings := list(group["missing"].explode().dropna().unique())),
            "message": f"{start} {shlex.join(recordings)}".strip(),
            "tasks": list(group["task"].unique()),
            "jobs": len(group),
        }
        for start, group in jobs.groupby(starts, sort=False)
    ]
