"""What the page of a task shows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from catalogue.data import posed, recordings
from catalogue.figures import ranking_figure
from catalogue.published import beside, printed
from catalogue.ranking import case_rows, ranking_basis, ranking_rows
from catalogue.reference import Today
from mocapbench.benchmark.archives import advise_supply
from mocapbench.benchmark.catalogue.entries import task_entry
from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.runs.request import entrants
from mocapbench.datasets import Archive
from mocapbench.reports.bundle.task_page import QUESTIONS
from mocapbench.reports.paper.citations import citations_of
from mocapbench.reports.paper.published import published_values

__all__ = ["task_page"]


def task_page(name: str, today: Today, archive: Archive) -> Mapping[str, Any]:
    """Return the values of the template of the task called ``name``.

    Parameters
    ----------
    name : str
    today : Today
    archive : Archive
        Of the recordings that are on this machine.
    """
    task, stored = TASKS.get(name), today.tasks.get(name)
    groups = recordings(task, archive)
    missing = [uri for group in groups for uri in group.missing]
    fetched = [uri for uri in missing if not archive.advice(uri)]
    return {
        "task": task,
        "page": task.page,
        "question": QUESTIONS[task.page.question],
        "abilities": task_entry(name)["requires"],
        "citations": citations_of([task.page.reference]),
        "groups": groups,
        "missing": [group for group in groups if group.missing],
        "fetch": archive.fetch_command(*fetched) if fetched else "",
        "supply": advise_supply(missing, archive),
        "posed": posed(task, archive),
        "columns": list(dict.fromkeys(c for case in task.cases for c in case.columns)),
        "entrants": entrants(task),
        "metrics": [METRICS.get(metric) for metric in task.page.metrics],
        "printed": printed(published_values(name).values()),
        "beside": beside(stored.results) if stored else [],
        "stored": stored,
        "figure": ranking_figure(stored.results, today.styles) if stored else None,
        "ranking": ranking_rows(stored.results) if stored else [],
        "single": case_rows(stored.results) if stored else [],
        "basis": ranking_basis(stored.results) if stored else "",
    }
