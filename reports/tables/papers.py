"""The papers' tables: how many values each has, and the verdicts on them."""

from __future__ import annotations

from collections.abc import Iterable

from mocapbench.reports.analysis.comparisons import (
    PublishedVerdict,
    count_by_source,
    count_published,
)
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.paper.citations import CITATIONS
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings
from mocapbench.reports.text import slug

__all__ = ["papers_table", "readable"]

PAPERS = {name.lower(): name for name in CITATIONS}
VERDICTS = tuple(verdict.value for verdict in PublishedVerdict)
COMPARED = set(VERDICTS) - {
    PublishedVerdict.NOT_COMPARABLE.value,
    PublishedVerdict.NOT_RUN.value,
}
COUNTS = ("values", *VERDICTS)
ALL = "all published values"


def papers_table(tasks: Iterable[TaskResults]) -> Table | None:
    """Return a row for each published table of the ``tasks``, and one for all values.

    Returns
    -------
    Table or None
        None where no value of ours has a published counterpart.
    """
    tasks = list(tasks)
    rows = [row for results in tasks for row in _rows(results)]
    totals = count_published(tasks)
    if not any(totals[verdict] for verdict in COMPARED):
        return None
    rows.append({"source": ALL, "task": "", "values": sum(totals.values()), **totals})
    return Table(
        id="scorecard",
        caption="The papers’ tables, with the verdicts on our numbers: every value counts once",
        columns=(*headings(["published in"]), *headings(["task"], "text"), *headings(COUNTS)),
        rows=tuple(
            (
                Cell(readable(str(row["source"]))),
                _task_cell(str(row["task"])),
                *(Cell(str(row[name])) if row[name] else ABSENT for name in COUNTS),
            )
            for row in rows
        ),
    )


def _rows(results: TaskResults) -> list[dict[str, object]]:
    """Return a row for each table that prints values of the task."""
    return [
        {"source": source, "task": results.layout.name, "values": sum(counts.values()), **counts}
        for source, counts in count_by_source(results).items()
    ]


def _task_cell(task: str) -> Cell:
    return Cell(task, kind="text", link=slug("task", task)) if task else Cell("", kind="text")


def readable(source: str) -> str:
    """Return "thesis table 1" for ``thesis-table-01``, "GPDM table 2" for ``gpdm-table-2``."""
    if source == ALL:
        return ALL
    paper, *place = source.split("-")
    return " ".join([PAPERS.get(paper, paper), *(part.lstrip("0") for part in place)])
