"""The papers' tables: how many values each has, and the verdicts on them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

import pandas as pd

from mocapbench.reports.analysis.comparisons import Comparison, every_comparison
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.verdicts import PublishedVerdict
from mocapbench.reports.paper.citations import CITATIONS
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings
from mocapbench.reports.text import slug

__all__ = ["papers_table"]

VERDICTS = tuple(verdict.value for verdict in PublishedVerdict)
PAPERS = {name.lower(): name for name in CITATIONS}
NO_SCORE = "no score of ours"
COUNTS = ("values", *VERDICTS, NO_SCORE)
NOTES = (
    "Values: how many numbers the paper prints in the table. The other columns count verdicts. A "
    "value that several of our entrants or cases correspond to has a verdict for each, so a row "
    "may have more verdicts than values.",
    "Not comparable: there is a reason not to compare the value, with or without a score of ours.",
)


def papers_table(tasks: Iterable[TaskResults]) -> Table | None:
    """Return a row for each published table of the ``tasks``, with a column for each verdict.

    Returns
    -------
    Table or None
        None where no value of ours has a published counterpart.
    """
    rows = [row for results in tasks for row in _rows(results)]
    if not any(row[verdict] for row in rows for verdict in VERDICTS):
        return None
    return Table(
        id="scorecard",
        caption="The papers’ tables, and the verdicts on our numbers beside theirs",
        columns=(*headings(["published in"]), *headings(["task"], "text"), *headings(COUNTS)),
        rows=tuple(
            (
                Cell(_readable(str(row["source"]))),
                Cell(str(row["task"]), kind="text", link=slug("task", str(row["task"]))),
                *(Cell(str(row[name])) if row[name] else ABSENT for name in COUNTS),
            )
            for row in rows
        ),
        data=pd.DataFrame(rows),
        notes=NOTES,
    )


def _rows(results: TaskResults) -> list[dict[str, object]]:
    """Return a row for each table that prints values of the task."""
    task, pairs = results.layout.name, every_comparison(results)
    by_source: dict[str, list[PublishedValue]] = {}
    for value in results.published.values():
        by_source.setdefault(value.source, []).append(value)
    return [_row(task, source, values, pairs) for source, values in by_source.items()]


def _row(
    task: str, source: str, values: Sequence[PublishedValue], comparisons: Sequence[Comparison]
) -> dict[str, object]:
    pairs = [pair for pair in comparisons if pair.published.source == source]
    counts = Counter(pair.verdict.value for pair in pairs)
    matched = {pair.published.address for pair in pairs}
    others = [value for value in values if value.address not in matched]
    not_compared = sum(bool(value.not_comparable) for value in others)
    counts[PublishedVerdict.NOT_COMPARABLE.value] += not_compared
    return {
        "source": source,
        "task": task,
        "values": len(values),
        **{verdict: counts[verdict] for verdict in VERDICTS},
        NO_SCORE: len(others) - not_compared,
    }


def _readable(source: str) -> str:
    """Return "thesis table 1" for ``thesis-table-01``, "GPDM table 2" for ``gpdm-table-2``."""
    paper, *place = source.split("-")
    return " ".join([PAPERS.get(paper, paper), *(part.lstrip("0") for part in place)])
