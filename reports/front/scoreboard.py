"""The scoreboard: models × tasks, shaded by distance from the best of each task."""

from __future__ import annotations

import math
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Any

import numpy as np

from mocapbench.basics.words import format_count
from mocapbench.metrics.base import Direction
from mocapbench.reports.analysis.results import DATA_MISSING, TaskResults
from mocapbench.reports.analysis.standings import Standing, standings
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.bundle.task_page import QUESTIONS
from mocapbench.reports.text import cell_anchor, number, slug

__all__ = [
    "FAILED",
    "INCOMPLETE",
    "LONGEST_UNIT",
    "SHADES",
    "WORSE",
    "BoardCell",
    "board_cells",
    "first_metric",
    "is_generated",
    "reference_of",
    "scoreboard",
]

SHADES = ((1.0, "best"), (1.1, "within 10 %"), (1.5, "within 50 %"), (3.0, "within 3×"))
"""How many times worse than the best a mean may be, and the name of that shade."""

INCOMPLETE = "incomplete"
"""In place of a shade: the mean is over other folds than that of the best, and not compared."""

FAILED = "failed"
"""In place of a shade: there is no mean, since the model failed."""

WORSE = "worse"
NEXT = 1.0 + 1e-9
"""Only the best has its shade, alone."""
TRIVIAL = "trivial"
REFERENCES = "References"
INTERPOLATION = "best interpolation"
LONGEST_UNIT = 8
"""Letters of a unit for which there is room."""
ARROWS = {Direction.LOWER: "↓", Direction.HIGHER: "↑", Direction.TARGET: "→"}


@dataclass(frozen=True)
class BoardCell:
    """The mean of one model in one task.

    Parameters
    ----------
    text : str
    value : float
        NaN where there is none.
    shade : str
        The name of its distance from the best, `INCOMPLETE` or `FAILED`; empty for what does not
        compete.
    beaten : bool
        Whether it is no better than the task's reference.
    link : str
        The address on the page of what is behind it, empty where nothing is.
    note : str
        What it says beside the number, such as the cases or folds that it lacks.
    """

    text: str
    value: float
    shade: str = ""
    beaten: bool = False
    link: str = ""
    note: str = ""

    @property
    def style(self) -> str:
        """Its classes in the style sheet."""
        if self.shade in (INCOMPLETE, FAILED):
            return self.shade
        step = [name for _, name in SHADES].index(self.shade) if self._near else len(SHADES)
        return f"shade-{step}" + (" beaten" if self.beaten else "") if self.shade else "reference"

    @property
    def _near(self) -> bool:
        return self.shade in {name for _, name in SHADES}


Column = Mapping[str, BoardCell]
Row = tuple[str, tuple[BoardCell | None, ...]]
"""A label and its cells: None where it took no part, or has no recording."""


def scoreboard(
    tasks: Sequence[TaskResults], families: Mapping[str, Sequence[str]]
) -> dict[str, Any]:
    """Return the scoreboard by the first metric of each task.

    Parameters
    ----------
    tasks : sequence of TaskResults
        In page order. Tasks without a score, and tables of pairs, are left out.
    families : mapping of str to sequence of str
        The labels of each family, families in the order of the rows.

    Returns
    -------
    dict
        The ``columns``; the ``questions``, each with its number of columns; ``groups`` of
        competitors, each a family and its rows; rows of ``references``, which are not shaded;
        ``has_beaten``, whether a model is no better than the reference of a task; and
        ``has_incomplete``, whether a model lacks folds that the best one of a task has.
    """
    shown = [task for task in tasks if board_cells(task) and not task.layout.page.crossed]
    columns = [_board_column(task) for task in shown]
    groups = {family: _rows(labels, columns) for family, labels in families.items()}
    references = [*groups.pop(REFERENCES, []), *_best_interpolations(shown, columns)]
    heads = [_describe_column(task) for task in shown]
    competing = [cell for rows in groups.values() for _, row in rows for cell in row if cell]
    questions = groupby(head["question"] for head in heads)
    return {
        "columns": heads,
        "questions": [(name, len(list(run))) for name, run in questions],
        "groups": [(family, rows) for family, rows in groups.items() if rows],
        "references": references,
        "has_beaten": any(cell.beaten for cell in competing),
        "has_incomplete": any(cell.shade == INCOMPLETE for cell in competing),
    }


def _board_column(results: TaskResults) -> Column:
    scored = board_cells(results)
    return {**scored, **_failed_cells(results, scored)}


def _rows(labels: Sequence[str], columns: Sequence[Column]) -> list[Row]:
    return [
        (label, tuple(column.get(label) for column in columns))
        for label in labels
        if any(label in column for column in columns)
    ]


def _describe_column(results: TaskResults) -> dict[str, str]:
    """Return the head of a task's column.

    Returns
    -------
    dict
        ``id``, ``title`` and ``long_title``, the anchor of its section, its short title and its
        title; the title of its ``question``; its first ``metric`` with the acronym or ``unit`` and
        an ``arrow`` to the better values; as ``basis`` how many cases its means are over, and
        whether all are of generated motion; and how many independent ``units`` these are.
    """
    metric, page = first_metric(results), results.layout.page
    ranked = standings(results, metric)
    cases = "synthetic case" if is_generated(results) else "case"
    return {
        "id": slug("task", results.layout.name),
        "title": page.short,
        "long_title": page.title,
        "question": QUESTIONS[page.question][0],
        "metric": metric,
        "unit": _unit(results.metrics[metric]),
        "arrow": ARROWS[results.metrics[metric].direction],
        "basis": format_count(len(results.representative_cases(metric)), cases),
        "units": ranked[0].units if ranked else "",
    }


def _unit(metric: MetricInfo) -> str:
    """Return a metric's unit, if a head has room for it, else the acronym in its title, if any."""
    if 0 < len(metric.unit) <= LONGEST_UNIT:
        return metric.unit
    return metric.acronym or ("error" if metric.direction is Direction.LOWER else "score")


def _best_interpolations(tasks: Sequence[TaskResults], columns: Sequence[Column]) -> list[Row]:
    """Return a row of the best interpolation of each task, none where no task has any."""
    cells = tuple(_best(task, column) for task, column in zip(tasks, columns, strict=True))
    return [(INTERPOLATION, cells)] if any(cells) else []


def _best(results: TaskResults, column: Column) -> BoardCell | None:
    """Return the cell of the best interpolation of a task that has every score, with its name."""
    ranked, known = standings(results, first_metric(results)), results.layout.interpolations
    labels = [each.label for each in ranked if each.complete and each.label in known]
    return replace(column[labels[0]], note=labels[0], shade="", beaten=False) if labels else None


def first_metric(results: TaskResults) -> str:
    """Return the metric by which the task is scored."""
    return results.layout.page.metrics[0]


def is_generated(results: TaskResults) -> bool:
    """Return whether all cases that count are of generated motion, which stands for recordings."""
    cases = results.representative_cases(first_metric(results))
    return bool(cases) and all(case.synthetic for case in cases)


def board_cells(results: TaskResults) -> Mapping[str, BoardCell]:
    """Return the cell of each label that has a score."""
    metric = first_metric(results)
    ranked = {standing.label: standing for standing in standings(results, metric)}
    return {
        label: _cell(results, metric, label, mean, ranked)
        for label in results.layout.labels
        if (mean := _mean(results, metric, label)) is not None
    }


def reference_of(results: TaskResults) -> str | None:
    """Return the label that a model has to beat: replayed training motion, else the channel mean.

    None where the task has neither.
    """
    metric, layout = first_metric(results), results.layout
    names = (layout.replay, TRIVIAL)
    return next((name for name in names if _mean(results, metric, name) is not None), None)


def _mean(results: TaskResults, metric: str, label: str) -> float | None:
    """Return the mean over the cases that count; None where the label has no score."""
    means = results.case_means(metric, label)
    return float(np.mean(means)) if means else None


def _mean_loss(results: TaskResults, metric: str, label: str) -> float:
    """Return the mean loss over the cases that count, where the label has a score."""
    return float(np.mean([*map(results.metrics[metric].loss, results.case_means(metric, label))]))


def _cell(
    results: TaskResults, metric: str, label: str, mean: float, ranked: Mapping[str, Standing]
) -> BoardCell:
    link = cell_anchor(results.layout.name, "", label)
    text = number(mean, results.decimals[metric])
    if label not in ranked:
        return BoardCell(text, mean, link=link)
    own, best = ranked[label], next(iter(ranked.values()))
    lacking = _lacking(own, best, len(results.representative_cases(metric)))
    if not own.complete:
        return BoardCell(text, mean, INCOMPLETE, link=link, note=f"{INCOMPLETE} ({lacking})")
    reference = reference_of(results)
    beaten = label != reference and _is_beaten(results, metric, label, reference)
    return BoardCell(text, mean, _shade(results, metric, own, best), beaten, link, lacking)


def _lacking(own: Standing, best: Standing, n_cases: int) -> str:
    """Return how much of the cases, or else of the best one's folds, there is; empty if all."""
    if own.n_cases < n_cases:
        return f"{own.n_cases} of {n_cases} cases"
    return "" if own.complete else f"{own.n_folds} of {best.n_folds} folds"


def _is_beaten(results: TaskResults, metric: str, label: str, reference: str | None) -> bool:
    """Return whether a label is no better than the reference."""
    if reference is None:
        return False
    own, other = (_mean_loss(results, metric, name) for name in (label, reference))
    return own >= other


def _shade(results: TaskResults, metric: str, own: Standing, best: Standing) -> str:
    """Return the name of the shade: how many times worse than the best a mean is."""
    times = 1.0 if own is best else _times_worse(results, metric, own, best)
    return next((name for most, name in SHADES if times <= most), WORSE)


def _times_worse(results: TaskResults, metric: str, own: Standing, best: Standing) -> float:
    """Return the ratio of a mean to the best one, above 1; infinite across zero.

    Where there is a target, it is of the mean distances from it.
    """
    sizes = [own.mean, best.mean]
    if results.metrics[metric].direction is Direction.TARGET:
        sizes = [_mean_loss(results, metric, one.label) for one in (own, best)]
    least, most = sorted(sizes)
    return max(most / least, NEXT) if least > 0.0 else math.inf


def _failed_cells(results: TaskResults, scored: Container[str]) -> Mapping[str, BoardCell]:
    """Return a cell for each label that failed and has no mean, which leads to a failure.

    Parameters
    ----------
    results : TaskResults
    scored : container of str
        The labels that have a mean.
    """
    by_label: dict[str, list[Any]] = {}
    for (_, label), failures in results.failures.items():
        failed = [failure for failure in failures if failure.status != DATA_MISSING]
        if failed and label not in scored:
            by_label.setdefault(label, []).extend(failed)
    tried = results.records[results.records["status"] != DATA_MISSING]["label"].value_counts()
    return {label: _failed_cell(failed, int(tried[label])) for label, failed in by_label.items()}


def _failed_cell(failed: Sequence[Any], n_jobs: int) -> BoardCell:
    note = f"in {len(failed)} of {n_jobs}"
    return BoardCell(FAILED, math.nan, FAILED, link=failed[0].id, note=note)
