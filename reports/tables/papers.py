"""What became of each table of the papers: its values, and the verdicts passed on them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

import pandas as pd

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.verdicts import Comparison, Verdict, every_comparison
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings, slug

__all__ = ["scorecard"]

VERDICTS = tuple(each.value for each in Verdict)
UNANSWERED = "no score of ours"
COUNTS = ("values", *VERDICTS, UNANSWERED)
NOTES = (
    "Values: what the paper prints there. The other columns count verdicts: a value that several "
    "entrants or cases of ours answer has one for each, and a row may have more than values.",
    "Not comparable: a reason stands beside the value, whether it has a score of ours or not.",
)


def scorecard(tasks: Iterable[TaskResults]) -> Table | None:
    """Return a row per published table of the ``tasks``; None where nothing is compared.

    A column counts verdicts, one for each pair of a published value and an estimate of ours.
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
                Cell(_spoken(str(row["source"]))),
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
    task: str, source: str, values: Sequence[PublishedValue], every: Sequence[Comparison]
) -> dict[str, object]:
    pairs = [pair for pair in every if pair.published.source == source]
    counts = Counter(pair.verdict.value for pair in pairs)
    answered = {pair.published.address for pair in pairs}
    others = [value for value in values if value.address not in answered]
    excused = sum(bool(value.not_comparable) for value in others)
    counts[Verdict.NOT_COMPARABLE.value] += excused
    return {
        "source": source,
        "task": task,
        "values": len(values),
        **{verdict: counts[verdict] for verdict in VERDICTS},
        UNANSWERED: len(others) - excused,
    }


def _spoken(source: str) -> str:
    """Return "thesis table 1" for ``thesis-table-01``."""
    return " ".join(part.lstrip("0") for part in source.split("-"))
