"""A headline on published values that are better than every value of the run."""

from __future__ import annotations

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.page.headline import Headline
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.text import counted

__all__ = ["published_headlines"]


def published_headlines(results: TaskResults, metric: str) -> list[Headline]:
    """Return one headline on the cases where the paper's best value is better than ours, if any."""
    loss = results.metrics[metric].loss
    published = {case.name: _best_published(results, case, metric) for case in results.cases}
    compared = [
        (case, value)
        for case, value in published.items()
        if value and results.ranking(case, metric)
    ]
    better = sum(loss(value.value) < _best_loss(results, case, metric) for case, value in compared)
    where = f"in {better} of {counted(len(compared), 'case')}."
    return [Headline("The paper prints better values than any here", where)] if better else []


def _best_published(results: TaskResults, case: CaseLayout, metric: str) -> PublishedValue | None:
    """Return the paper's best comparable value for ``case``; None for generated motion."""
    page, notes = results.layout.page, case.notes
    row = (None if case.synthetic else notes.published, page.published_metrics.get(metric))
    not_comparable = {page.published_models.get(label) for label in notes.not_comparable}
    values = [
        value
        for value in results.published.values()
        if (value.case, value.metric) == row
        and value.model not in not_comparable
        and not value.not_comparable
    ]
    loss = results.metrics[metric].loss
    return min(values, key=lambda value: loss(value.value), default=None)


def _best_loss(results: TaskResults, case: str, metric: str) -> float:
    best = results.ranking(case, metric)[0]
    return results.metrics[metric].loss(results.estimates[case, best, metric].mean)
