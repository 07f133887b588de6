"""The table of what a paper prints of single folds, beside ours."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings
from mocapbench.reports.text import number, slug

__all__ = ["fold_table"]

Row = tuple[Cell, ...]


def fold_table(results: TaskResults, metric: str) -> Table | None:
    """Return a row for each fold of which a paper prints the ``metric``; None where none does.

    What is better than printed is marked. Before the folds of a case, a row counts these.
    """
    printed = results.layout.page.published_folds
    cases = [case.name for case in results.cases if case.name in printed]
    labels = [
        label
        for label in results.layout.ranked
        if any(results.estimate(case, label, metric) for case in cases)
    ]
    if not labels:
        return None
    return Table(
        id=slug(results.layout.name, metric, "folds"),
        caption=f"{results.metrics[metric].short}, fold by fold beside what is published",
        columns=headings(["fold", "published", *labels]),
        rows=tuple(
            row
            for case in cases
            for row in _case_rows(results, metric, case, labels, printed[case])
        ),
    )


def _case_rows(
    results: TaskResults,
    metric: str,
    case: str,
    labels: Sequence[str],
    printed: Sequence[float],
) -> Iterator[Row]:
    """Yield how many folds of a case are better than printed, and then each fold."""
    loss, ours = results.metrics[metric].loss, []
    for label in labels:
        values = results.values_by_fold(case, label, metric)
        better = {fold for fold, value in values.items() if loss(value) < loss(printed[fold])}
        ours.append((values, better))
    counts = (Cell(f"{len(better)} of {len(values)}") for values, better in ours)
    yield Cell(f"{case}: better in"), ABSENT, *counts
    for fold, value in enumerate(printed):
        cells = (
            Cell(number(values[fold], 3), kind="best" if fold in better else "")
            if fold in values
            else ABSENT
            for values, better in ours
        )
        yield Cell(f"{case}, fold {fold}"), Cell(number(value, 3), kind="published"), *cells
