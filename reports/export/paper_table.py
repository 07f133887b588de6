"""From the means of a task to its table: the best in bold, marks of tests, and what they are of."""

from __future__ import annotations

import math
from collections.abc import Mapping

import pandas as pd

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import Place
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.export.means import REFERENCE
from mocapbench.reports.tables.base import ABSENT, Cell, Table
from mocapbench.reports.text import number, slug

__all__ = ["build_table", "describe_protocol"]

BEST = "best"
"""The kind of the cells that are bold."""
_MARKS = {Place.INSEPARABLE.value: "†", Place.INCOMPLETE.value: "*"}
_UNTESTED = "‡"
_MEANINGS = {
    "†": "the difference from the best may be chance (paired t-test, Holm’s method over a column)",
    "*": "over fewer cases or folds than the best, so not compared",
    _UNTESTED: "too few to test",
}


def build_table(results: TaskResults, means: pd.DataFrame, profile: str) -> Table:
    """Return the table of `mocapbench.reports.export.means`: a row a model, a column a mean.

    Parameters
    ----------
    results : TaskResults
    means : DataFrame
        One row or more.
    profile : str
        That of the run.
    """
    columns = [*means.groupby(["metric", "case"], sort=False)]
    counts = {_count_units(column) for _, column in columns}
    places = {name: results.decimals[name] for name in means["metric"].unique()}
    heads = [_head(results.metrics, means, column, len(counts) > 1) for _, column in columns]
    cells = [_column_cells(column, places[metric]) for (metric, _), column in columns]
    references = {*means["label"][means["test"] == REFERENCE]}
    labels = [label for label in results.layout.labels if label in {*means["label"]}]
    rows = tuple(
        (
            Cell(label, kind=REFERENCE if label in references else ""),
            *(column.get(label, ABSENT) for column in cells),
        )
        for label in labels
    )
    kinds = {cell.kind for row in rows for cell in row}
    used = {cell.mark for row in (heads, *rows) for cell in row}
    return Table(
        id=slug(results.layout.name, *places),
        caption=_caption(results, means, profile),
        columns=(Cell("model"), *heads),
        rows=rows,
        notes=(
            _describe_numbers(counts, has_intervals=bool(means["half_width"].notna().any())),
            *(["Bold: the best."] if BEST in kinds else []),
            *(f"{mark}: {meaning}." for mark, meaning in _MEANINGS.items() if mark in used),
            *([f"Not ranked: {', '.join(sorted(references))}."] if references else []),
        ),
    )


def _head(
    metrics: Mapping[str, MetricInfo], means: pd.DataFrame, column: pd.DataFrame, counted: bool
) -> Cell:
    """Return the head of a column: its metric where there are several, else its case."""
    first = column.iloc[0]
    several = means["metric"].nunique() > 1
    return Cell(
        metrics[first["metric"]].quantity if several else first["case"],
        note=_count_units(column) if counted else "",
        mark=_UNTESTED if Place.UNTESTED.value in {*column["test"]} else "",
    )


def _count_units(column: pd.DataFrame) -> str:
    """Return over how many units a column is, of its label with the most."""
    return format_count(int(column["n"].max()), str(column["n_of"].iloc[0]))


def _column_cells(column: pd.DataFrame, places: int) -> dict[str, Cell]:
    """Return the cell of each label; the best of several is bold."""
    compared = int((column["test"] != REFERENCE).sum()) > 1
    return {
        row["label"]: Cell(
            number(row["mean"], places),
            spread="" if math.isnan(row["half_width"]) else number(row["half_width"], places),
            mark=_MARKS.get(row["test"], ""),
            kind=BEST if compared and row["test"] == Place.BEST.value else "",
            value=row["mean"],
        )
        for row in column.to_dict("records")
    }


def _caption(results: TaskResults, means: pd.DataFrame, profile: str) -> str:
    """Return the task and its protocol, and each metric with its unit and direction."""
    names = dict.fromkeys(means["metric"])
    metrics = "; ".join(_describe_metric(results.metrics[name]) for name in names)
    over = {*means["case"]} if len(names) > 1 else set()
    cases = f" ({', '.join(sorted(over))})" if over else ""
    return f"{describe_protocol(results.layout, profile)}: {metrics}{cases}."


def describe_protocol(layout: TaskLayout, profile: str) -> str:
    """Return the title of a task, its place in a paper, and what the run reduced."""
    protocol = [layout.page.reference, f"profile {profile}" if profile else "", layout.budget]
    return f"{layout.page.title} ({', '.join(filter(None, protocol))})"


def _describe_metric(metric: MetricInfo) -> str:
    known = not metric.unit or metric.unit in metric.title
    unit = "" if known else f", unit: {metric.unit}"
    return f"{metric.title}{unit}, {metric.better} is better"


def _describe_numbers(counts: set[str], *, has_intervals: bool) -> str:
    n = next(iter(counts)) if len(counts) == 1 else "as many units as each column says"
    spread = " ± half of its 95 % interval by Student’s t" if has_intervals else ""
    return f"Mean{spread} over {n}."
