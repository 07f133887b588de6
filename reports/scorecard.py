"""What became of each table of the papers: its values, and the verdicts passed on them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

import pandas as pd

from mocapbench.reports.published import PublishedValue
from mocapbench.reports.results import TaskResults
from mocapbench.reports.tables import ABSENT, Cell, Table, headings, slug
from mocapbench.reports.verdicts import Comparison, Verdict, comparisons

__all__ = ["scorecard"]

VERDICTS = tuple(each.value for each in Verdict)
NOTES = (
    "Values: what the paper prints there. Not run: those with no score of ours beside them.",
    "A value that several entrants or cases of ours answer counts once for each, so that a row "
    "may have more verdicts than values.",
)


def scorecard(tasks: Iterable[TaskResults]) -> Table | None:
    """Return a row per published table of the ``tasks``; None where nothing is compared."""
    rows = [row for results in tasks for row in _rows(results)]
    if not any(row[verdict] for row in rows for verdict in VERDICTS):
        return None
    counts = ("values", *VERDICTS, "not run")
    return Table(
        id="scorecard",
        caption="The papers’ tables, and how many of our numbers agree with theirs",
        columns=(*headings(["published in"]), *headings(["task"], "text"), *headings(counts)),
        rows=tuple(
            (
                Cell(_spoken(str(row["source"]))),
                Cell(str(row["task"]), kind="text", link=slug("task", str(row["task"]))),
                *(Cell(str(row[name])) if row[name] else ABSENT for name in counts),
            )
            for row in rows
        ),
        data=pd.DataFrame(rows),
        notes=NOTES,
    )


def _rows(results: TaskResults) -> list[dict[str, object]]:
    """Return a row for each table that prints values of the task."""
    layout = results.layout
    pairs = [pair for metric in layout.metrics for pair in comparisons(results, metric)]
    by_source: dict[str, list[PublishedValue]] = {}
    for value in results.published.values():
        by_source.setdefault(value.source, []).append(value)
    return [_row(layout.name, source, values, pairs) for source, values in by_source.items()]


def _row(
    task: str, source: str, values: Sequence[PublishedValue], every: Sequence[Comparison]
) -> dict[str, object]:
    pairs = [pair for pair in every if pair.published.source == source]
    counts = Counter(pair.verdict.value for pair in pairs)
    answered = {pair.published.address for pair in pairs}
    return {
        "source": source,
        "task": task,
        "values": len(values),
        **{verdict: counts[verdict] for verdict in VERDICTS},
        "not run": sum(value.address not in answered for value in values),
    }


def _spoken(source: str) -> str:
    """Return "thesis table 1" for ``thesis-table-01``."""
    return " ".join(part.lstrip("0") for part in source.split("-"))
