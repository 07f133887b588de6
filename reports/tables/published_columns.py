"""The columns of a score table for the paper's models that have no entrant in the run."""

from __future__ import annotations

from collections.abc import Mapping

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.paper.remarks import marks
from mocapbench.reports.tables.base import ABSENT, Cell
from mocapbench.reports.text import number, plus_minus

__all__ = ["lettered_errata", "published_cells", "unmatched_models"]


def unmatched_models(results: TaskResults, metric: str) -> list[str]:
    """Return the paper's models with values of ``metric`` that none of our labels stands for."""
    page = results.layout.page
    models = dict.fromkeys(
        value.model
        for value in results.published.values()
        if value.metric == page.published_metrics.get(metric) and not value.not_comparable
    )
    return [model for model in models if model not in page.published_models.values()]


def lettered_errata(results: TaskResults, metric: str) -> dict[str, str]:
    """Return a letter for every erratum of the columns, in the order of the table's cells."""
    values = (
        _value(results, case, metric, model)
        for case in results.cases
        for model in unmatched_models(results, metric)
    )
    return marks(value.erratum for value in values if value is not None)


def published_cells(
    results: TaskResults, case: CaseLayout, metric: str, places: int, errata: Mapping[str, str]
) -> list[Cell]:
    """Return the cells of ``case``, one for each model, marked with the letters of ``errata``."""
    models = unmatched_models(results, metric)
    return [_cell(_value(results, case, metric, model), places, errata) for model in models]


def _value(
    results: TaskResults, case: CaseLayout, metric: str, model: str
) -> PublishedValue | None:
    """Return the published value of ``model`` for ``case``; None for generated motion."""
    row = case.notes.published
    if case.synthetic or row is None:
        return None
    return results.published.get((row, results.layout.page.published_metrics[metric], model))


def _cell(value: PublishedValue | None, places: int, errata: Mapping[str, str]) -> Cell:
    if value is None:
        return ABSENT
    spread, mark = plus_minus(value.two_sd, places), errata[value.erratum]
    return Cell(number(value.value, places), spread=spread, mark=mark, kind="published")
