"""The means of a task with their intervals and tests, one a row: what its table shows, unrounded.

A column of the table is a mean over some cases, by a metric. Every number and every test is that of
the report (`mocapbench.reports.analysis`): the tests of a column are one family.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import pandas as pd

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.cells import cells
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import standings
from mocapbench.reports.bundle.layout import CaseLayout

__all__ = ["REFERENCE", "columns_of", "tabulate_means"]

REFERENCE = "reference"
"""In place of a test: the label is a limit or a control, and not compared."""

_COLUMNS = (
    *("task", "case", "metric", "unit", "label", "mean", "half_width", "n", "n_of"),
    *("test", "difference", "low", "high"),
)
_NO_TEST = (REFERENCE, np.nan, np.nan, np.nan)


def tabulate_means(results: TaskResults, metrics: Sequence[str]) -> pd.DataFrame:
    """Return one row for each mean of a task's table, column by column.

    Of one metric there are a column for the mean over cases and one for each case; of several, a
    column for the mean of each.

    Parameters
    ----------
    results : TaskResults
    metrics : sequence of str
        In the order in which they are shown.

    Returns
    -------
    DataFrame
        Columns ``task``, ``case`` (or over how many), ``metric`` and its ``unit``, ``label``,
        ``mean``, ``half_width`` of its 95 % interval, ``n``, the number of independent units of the
        kind ``n_of``, how ``test`` finds it beside the best one of the column, and its
        ``difference`` in loss from that with the interval from ``low`` to ``high``, at the level of
        Holm's method. NaN where there is no interval or no test. What has no score has no row.
    """
    rows = [
        row
        for metric in metrics
        for name, cases in columns_of(results, metric, alone=len(metrics) == 1)
        for row in _column_rows(results, metric, name, cases)
    ]
    return pd.DataFrame(rows, columns=list(_COLUMNS))


def columns_of(
    results: TaskResults, metric: str, *, alone: bool
) -> Iterator[tuple[str, Sequence[CaseLayout]]]:
    """Yield the name and the cases of each column of a metric, which may be shown alone."""
    counting = results.representative_cases(metric) or results.cases
    if len(counting) > 1:
        yield f"mean of {format_count(len(counting), 'case')}", counting
    elif not alone:
        yield counting[0].name, counting
    if alone:
        yield from ((case.name, [case]) for case in results.cases)


def _column_rows(
    results: TaskResults,
    metric: str,
    name: str,
    cases: Sequence[CaseLayout],
) -> Iterator[tuple[object, ...]]:
    scored = cells(results, metric, cases, results.layout.labels)
    tests = {
        one.label: (one.standing.value, one.difference, one.low, one.high)
        for one in standings(results, metric, cases)
    }
    column = (results.layout.name, name, metric, results.metrics[metric].unit)
    for row, label in enumerate(scored.labels):
        mean = (scored.mean(row), scored.half_width(row), scored.n_units(row), scored.unit)
        yield (*column, label, *mean, *tests.get(label, _NO_TEST))
