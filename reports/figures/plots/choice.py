"""Which metrics a figure shows, and which models a figure of curves has room for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import pandas as pd

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.export.selection import order_labels
from mocapbench.reports.figures.scores.best import best_labels

__all__ = ["choose_labels", "choose_metrics", "count_models", "describe_choice"]

MOST_CURVES = 8
"""More cannot be told apart."""
_BEST = 4
_OF_MODELS = "of models"


def choose_labels(results: TaskResults, metric: str, among: Iterable[str]) -> list[str]:
    """Return the labels to draw, best first: all if these are few, else those of most interest.

    These are the best, the models of the papers, the best interpolation and the best of yours.
    """
    known = {*among}
    ordered = [name for name in order_labels(results, metric).layout.labels if name in known]
    if len(ordered) <= MOST_CURVES:
        return ordered
    papers = [name for name in ordered if name in results.layout.page.published_models]
    chosen = {*best_labels(results, metric, known, _BEST), *papers[:_BEST]}
    return [name for name in ordered if name in chosen]


def count_models(table: pd.DataFrame, n_models: int) -> pd.DataFrame:
    """Return a figure's table, which then knows of how many models `choose_labels` chose."""
    table.attrs[_OF_MODELS] = n_models
    return table


def describe_choice(table: pd.DataFrame) -> str:
    """Return a sentence for captions on what `choose_labels` chose; empty if it took all."""
    n_models = table.attrs.get(_OF_MODELS, 0)
    if n_models <= MOST_CURVES:
        return ""
    return (
        f"Of {n_models} models the best are drawn, with some of the papers, the best interpolation "
        "and yours."
    )


def choose_metrics(results: TaskResults, named: Sequence[str]) -> list[str]:
    """Return the metrics that are named and have scores; by default the first of the task's page.

    Parameters
    ----------
    results : TaskResults
    named : sequence of str
        Empty for the default.
    """
    scored = {*results.scores["metric"]}
    if named:
        return [metric for metric in named if metric in scored]
    return [metric for metric in results.layout.page.metrics if metric in scored][:1]
