"""The columns of a score table for the paper's models that have no entrant in the run."""

from __future__ import annotations

from collections.abc import Mapping

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.tables.base import ABSENT, Cell
from mocapbench.reports.text import number, plus_minus

__all__ = ["published_cell", "published_counterpart", "unmatched_models"]


def unmatched_models(results: TaskResults, metric: str) -> list[str]:
    """Return the paper's models with values of ``metric`` that none of our labels stands for."""
    page = results.layout.page
    models = dict.fromkeys(
        value.model
        for value in results.published.values()
        if value.metric == page.published_metrics.get(metric) and not value.not_comparable
    )
    return [model for model in models if model not in page.published_models.values()]


def published_counterpart(
    results: TaskResults, case: CaseLayout, metric: str, model: str
) -> PublishedValue | None:
    """Return the published value of ``model`` for ``case``; None for generated motion."""
    row = case.notes.published
    if case.synthetic or row is None:
        return None
    return results.published.get((row, results.layout.page.published_metrics[metric], model))


def published_cell(value: PublishedValue | None, places: int, lettered: Mapping[str, str]) -> Cell:
    """Return the cell of a published value, marked with the letter of its erratum."""
    if value is None:
        return ABSENT
    spread, mark = plus_minus(value.two_sd, places), lettered[value.erratum]
    return Cell(number(value.value, places), spread=spread, mark=mark, kind="published")
