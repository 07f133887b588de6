"""What the dialog of a cell shows: everything of every cell as one compact JSON document.

A cell is a task, a case and a label. Each stands in its task as a row of values, which
``columns`` names. What many cells have in common, such as parameters, pieces of commands and
digests of recordings, stands once in ``shared`` and is referred to by its place there.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

from jinja2.utils import htmlsafe_json_dumps
from markupsafe import Markup

from mocapbench.reports.analysis.published.comparisons import Comparison, comparisons
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.bundle.origin import Origin
from mocapbench.reports.page.cell_rows import COLUMNS, CellScore, Job, Shared, cell_row

__all__ = ["Origins", "cells_json"]

Origins = Mapping[tuple[str, str, str], Origin]
"""By task, case and label."""

_GOALS = {"lower": "lower is better", "higher": "higher is better"}
_UNKNOWN = Origin((), 0, {}, {})


def cells_json(results: Sequence[TaskResults], origins: Origins) -> Markup:
    """Return the cells of all tasks as JSON that may stand in a script element.

    Parameters
    ----------
    results : sequence of TaskResults
    origins : mapping of (task, case, label) to Origin
        Cells without one have neither keys nor command.
    """
    shared = Shared()
    tasks = {of_task.layout.name: _task(of_task, origins, shared) for of_task in results}
    document = {"columns": COLUMNS, "tasks": tasks, "shared": shared.values}
    return htmlsafe_json_dumps(document, dumps=partial(json.dumps, separators=(",", ":")))


def _task(results: TaskResults, origins: Origins, shared: Shared) -> dict[str, Any]:
    layout, scores = results.layout, _scores(results)
    metrics = layout.page.metrics
    return {
        "title": layout.page.title,
        "metrics": [_metric(results.metrics[metric]) for metric in metrics],
        "rows": [
            cell_row(
                cell,
                jobs,
                origins.get((layout.name, *cell), _UNKNOWN),
                results.failures.get(cell, ()),
                [scores.get((*cell, metric)) for metric in metrics],
                shared=shared,
            )
            for cell, jobs in _jobs(results).items()
        ],
    }


def _metric(info: MetricInfo) -> list[str]:
    return [info.name, info.short, _GOALS.get(info.direction.value, f"{info.target} is ideal")]


def _jobs(results: TaskResults) -> dict[tuple[str, str], list[Job]]:
    """Return the jobs of each cell by fold, cells in table order."""
    names = ("case", "label", "fold", "model", "parameters")
    costs = ("fit_seconds", "predict_seconds", "peak_memory_mb")
    cells: dict[tuple[str, str], list[Job]] = {
        (case.name, label): [] for case in results.cases for label in results.layout.labels
    }
    columns = (results.records[name].tolist() for name in (*names, *costs))
    for case, label, *job in zip(*columns, strict=True):
        cells[case, label].append(tuple(job))
    return {cell: sorted(jobs, key=lambda job: job[0]) for cell, jobs in cells.items() if jobs}


def _scores(results: TaskResults) -> dict[tuple[str, str, str], CellScore]:
    """Return every score of the metrics that the page shows, by case, label and metric."""
    values, published = _values(results), _compare_published(results)
    return {
        address: CellScore(estimate, published.get(address), values[address])
        for address, estimate in results.estimates.items()
        if address[2] in results.layout.page.metrics
    }


def _values(results: TaskResults) -> dict[tuple[str, str, str], dict[int, float]]:
    """Return the finite values by case, label and metric, by fold."""
    by_fold: dict[tuple[str, str, str], dict[int, float]] = {}
    names = ("case", "label", "metric", "fold", "value")
    columns = (results.scores[name].tolist() for name in names)
    for case, label, metric, fold, value in zip(*columns, strict=True):
        by_fold.setdefault((case, label, metric), {})[fold] = value
    return by_fold


def _compare_published(results: TaskResults) -> dict[tuple[str, str, str], Comparison]:
    return {
        (pair.case.name, pair.label, metric): pair
        for metric in results.layout.page.metrics
        for pair in comparisons(results, metric)
    }
