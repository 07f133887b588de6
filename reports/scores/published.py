"""The rows of a table of scores for the paper's models that no entrant of the run stands for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.scores.table import NO_SCORE, ScoreCell, ScoreRow
from mocapbench.reports.text import number

__all__ = ["published_rows"]

Printed = Mapping[str, PublishedValue]
"""The values of one model by the paper's name of the case."""


def published_rows(
    results: TaskResults,
    metric: str,
    counting: Sequence[CaseLayout],
    shown: Sequence[CaseLayout],
    places: int,
) -> Iterator[ScoreRow]:
    """Return a row for each model; its mean is that of the cases ``counting``, if all have one."""
    for model, printed in _by_model(results, metric).items():
        values = [_value(case, printed) for case in counting]
        if not any(values):
            continue
        whole = [value.value for value in values if value is not None]
        mean = _cell(float(np.mean(whole)), places) if len(whole) == len(values) else NO_SCORE
        cells = tuple(_show_published(_value(case, printed), places) for case in shown)
        yield ScoreRow(f"{model} (published)", "published", mean, NO_SCORE, None, cells)


def _by_model(results: TaskResults, metric: str) -> dict[str, dict[str, PublishedValue]]:
    page = results.layout.page
    name, ours = page.published_metrics.get(metric), set(page.published_models.values())
    models: dict[str, dict[str, PublishedValue]] = {}
    for value in results.published.values():
        if value.metric == name and value.model not in ours and not value.not_comparable:
            models.setdefault(value.model, {})[value.case] = value
    return models


def _value(case: CaseLayout, printed: Printed) -> PublishedValue | None:
    return None if case.synthetic else printed.get(case.notes.published or "")


def _show_published(value: PublishedValue | None, places: int) -> ScoreCell:
    return NO_SCORE if value is None else _cell(value.value, places)


def _cell(value: float, places: int) -> ScoreCell:
    return ScoreCell(number(value, places), value, "published")
