"""The ranking of a task as a table: a row for each entrant, a column for each metric."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import standings
from mocapbench.reports.figures.scores.best import mean_values
from mocapbench.reports.front.scoreboard import board_cells, first_metric
from mocapbench.reports.scores.table import describe_basis
from mocapbench.reports.tables.base import ABSENT
from mocapbench.reports.text import FEWEST_DECIMALS, number

__all__ = ["Ranked", "case_rows", "ranking_basis", "ranking_rows"]


class Ranked(NamedTuple):
    """A row: the place or the case, the entrant, its model and its means."""

    place: str
    label: str
    model: str
    means: Sequence[str]


def ranking_rows(results: TaskResults) -> list[Ranked]:
    """Return the rows: those that compete best first, then references."""
    ranked = [standing.label for standing in standings(results, first_metric(results))]
    cells, layout = board_cells(results), results.layout
    others = [label for label in layout.labels if label in cells and label not in ranked]
    means = [_means(results, metric) for metric in layout.page.metrics[1:]]
    return [
        Ranked(
            str(1 + ranked.index(label)) if label in ranked else "",
            label,
            layout.model(label).name,
            [cells[label].text, *(column.get(label, ABSENT.text) for column in means)],
        )
        for label in (*ranked, *others)
    ]


def case_rows(results: TaskResults) -> list[Ranked]:
    """Return a row for each case and entrant, of a task in which nothing competes."""
    layout = results.layout
    return [
        Ranked(case.name, label, layout.model(label).name, _cells(results, case.name, label))
        for case in results.cases
        for label in layout.labels
    ]


def _cells(results: TaskResults, case: str, label: str) -> list[str]:
    """Return the means over folds by all metrics of the page."""
    metrics = results.layout.page.metrics
    found = [(metric, results.estimate(case, label, metric)) for metric in metrics]
    return [
        number(mean.mean, results.decimals[metric]) if mean else ABSENT.text
        for metric, mean in found
    ]


def _means(results: TaskResults, metric: str) -> dict[str, str]:
    """Return the mean of each label that has a score in every case that counts."""
    places = results.decimals.get(metric, FEWEST_DECIMALS)
    return {label: number(mean, places) for label, mean in mean_values(results, metric).items()}


def ranking_basis(results: TaskResults) -> str:
    """Return what the means of the first metric are over, such as ``"6 cases, 12 folds each"``."""
    metric = first_metric(results)
    cases = results.representative_cases(metric)
    generated = cases and all(case.synthetic for case in cases)
    return describe_basis(results, metric, cases) + (", of generated gait" if generated else "")
