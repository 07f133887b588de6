"""The scoreboard, made from the results of all tasks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from mocapbench.basics.words import format_count
from mocapbench.metrics.base import Direction
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import standings
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.bundle.questions import question
from mocapbench.reports.front.board import BoardCell, BoardColumn, BoardRow, Scoreboard
from mocapbench.reports.front.board_cells import board_cells, first_metric, is_generated
from mocapbench.reports.front.failed_cells import failed_cells
from mocapbench.reports.text import slug

__all__ = ["scoreboard"]

REFERENCES = "References"
INTERPOLATION = "best interpolation"
LONGEST_UNIT = 8
ARROWS = {Direction.LOWER: "↓", Direction.HIGHER: "↑", Direction.TARGET: "→"}

Column = Mapping[str, BoardCell]


def scoreboard(tasks: Sequence[TaskResults], families: Mapping[str, Sequence[str]]) -> Scoreboard:
    """Return the scoreboard by the first metric of each task.

    Parameters
    ----------
    tasks : sequence of TaskResults
        In page order. Tasks without a score, and tables of pairs, are left out.
    families : mapping of str to sequence of str
        The labels of each family, families in the order of the rows.
    """
    shown = [task for task in tasks if board_cells(task) and not task.layout.page.crossed]
    columns = [_cells(task) for task in shown]
    groups = {family: _rows(labels, columns) for family, labels in families.items()}
    below = groups.pop(REFERENCES, ())
    return Scoreboard(
        tuple(map(_column, shown)),
        tuple((family, rows) for family, rows in groups.items() if rows),
        (*below, *_best_interpolations(shown, columns)),
    )


def _cells(results: TaskResults) -> Column:
    scored = board_cells(results)
    return {**scored, **failed_cells(results, scored)}


def _rows(labels: Sequence[str], columns: Sequence[Column]) -> tuple[BoardRow, ...]:
    return tuple(
        BoardRow(label, tuple(column.get(label) for column in columns))
        for label in labels
        if any(label in column for column in columns)
    )


def _column(results: TaskResults) -> BoardColumn:
    metric, page = first_metric(results), results.layout.page
    ranked = standings(results, metric)
    cases = "synthetic case" if is_generated(results) else "case"
    return BoardColumn(
        id=slug("task", results.layout.name),
        title=page.short,
        question=question(page.question).title,
        metric=metric,
        unit=_unit(results.metrics[metric]),
        arrow=ARROWS[results.metrics[metric].direction],
        basis=format_count(len(results.representative_cases(metric)), cases),
        units=ranked[0].units if ranked else "",
        long_title=page.title,
    )


def _unit(metric: MetricInfo) -> str:
    """Return a metric's unit, if a head has room for it, else the acronym in its title, if any."""
    if 0 < len(metric.unit) <= LONGEST_UNIT:
        return metric.unit
    return metric.acronym or ("error" if metric.direction is Direction.LOWER else "score")


def _best_interpolations(
    tasks: Sequence[TaskResults], columns: Sequence[Column]
) -> Sequence[BoardRow]:
    """Return a row of the best interpolation of each task, none where no task has any."""
    cells = tuple(_best(task, column) for task, column in zip(tasks, columns, strict=True))
    return (BoardRow(INTERPOLATION, cells),) if any(cells) else ()


def _best(results: TaskResults, column: Column) -> BoardCell | None:
    """Return the cell of the best interpolation of a task that has every score, with its name."""
    ranked, known = standings(results, first_metric(results)), results.layout.interpolations
    labels = [each.label for each in ranked if each.complete and each.label in known]
    return replace(column[labels[0]], note=labels[0], shade="", beaten=False) if labels else None
