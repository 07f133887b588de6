"""The table of calibration: metrics of a distribution with a target, beside that target."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.metrics.base import Direction
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings
from mocapbench.reports.text import number, slug

__all__ = ["calibration_table"]


def calibration_table(results: TaskResults) -> Table | None:
    """Return the means of metrics of a distribution that have a target: coverage of intervals.

    Means run over folds and then over the cases that count. Metrics that the task shows in a
    separate table are left out.

    Returns
    -------
    Table or None
        None where no entrant has a score by such a metric.
    """
    metrics = [name for name in _targets(results) if name not in results.layout.page.metrics]
    means = {
        label: {metric: _mean_over_cases(results, label, metric) for metric in metrics}
        for label in results.layout.labels
    }
    scored = {
        label: by_metric
        for label, by_metric in means.items()
        if any(mean is not None for mean in by_metric.values())
    }
    if not scored:
        return None
    return Table(
        id=slug(results.layout.name, "calibration"),
        caption="Calibration: means beside the nominal value",
        columns=headings(["entrant", *(results.metrics[metric].title for metric in metrics)]),
        rows=(
            (Cell("nominal"), *(_nominal(results, metric) for metric in metrics)),
            *(
                (Cell(label), *map(_fraction, by_metric.values()))
                for label, by_metric in scored.items()
            ),
        ),
    )


def _targets(results: TaskResults) -> Sequence[str]:
    scored = set(results.scores["metric"])
    return [
        name
        for name, info in results.metrics.items()
        if info.of_distribution and info.direction is Direction.TARGET and name in scored
    ]


def _mean_over_cases(results: TaskResults, label: str, metric: str) -> float | None:
    means = results.case_means(metric, label)
    return float(np.mean(means)) if means else None


def _nominal(results: TaskResults, metric: str) -> Cell:
    return Cell(number(results.metrics[metric].target or 0.0, 2), kind="published")


def _fraction(value: float | None) -> Cell:
    return ABSENT if value is None else Cell(number(value, 2))
