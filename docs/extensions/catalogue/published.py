"""The values that papers print of a task, and those of ours that answer them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.paper.remarks import footnotes, marks
from mocapbench.reports.tables.base import Table
from mocapbench.reports.tables.papers import readable
from mocapbench.reports.tables.verdicts import verdict_table

__all__ = ["Printed", "beside", "printed"]

Column = tuple[str, str]
"""A metric and a model, in the paper's names."""


@dataclass(frozen=True)
class Printed:
    """One table of a paper: a row a case, a column for each metric and model.

    Parameters
    ----------
    title : str
        ``"thesis table 1"``.
    columns : sequence of (metric, model)
    rows : mapping of str to sequence of str
        The cells of each case; empty where the paper prints nothing.
    notes : sequence of str
        On errors of the paper, and on what cannot be compared.
    """

    title: str
    columns: Sequence[Column]
    rows: Mapping[str, Sequence[str]]
    notes: Sequence[str]


def printed(values: Iterable[PublishedValue]) -> list[Printed]:
    """Return the tables that print ``values``, of which those of one table stand together."""
    by_source = groupby(values, key=lambda value: value.source)
    return [_table(source, list(group)) for source, group in by_source]


def beside(results: TaskResults) -> list[Table]:
    """Return the report's tables of our values beside the published ones, one a metric."""
    tables = (verdict_table(results, metric) for metric in results.layout.page.metrics)
    return [table for table in tables if table is not None]


def _table(source: str, values: Sequence[PublishedValue]) -> Printed:
    columns = list(dict.fromkeys((value.metric, value.model) for value in values))
    lettered = marks(note for value in values for note in (value.erratum, value.not_comparable))
    cells = {(v.case, (v.metric, v.model)): _cell(v, lettered) for v in values}
    rows = {
        case: [cells.get((case, column), "") for column in columns]
        for case in dict.fromkeys(value.case for value in values)
    }
    return Printed(readable(source), columns, rows, footnotes(lettered))


def _cell(value: PublishedValue, lettered: Mapping[str, str]) -> str:
    """Return the number as the paper has it, with its ± and the letters of its notes."""
    spread = "" if value.two_sd is None else f" ± {value.two_sd:g}"
    letters = filter(None, (lettered[value.erratum], lettered[value.not_comparable]))
    noted = ", ".join(letters)
    return f"{value.value:g}{spread}" + (f" ({noted})" if noted else "")
