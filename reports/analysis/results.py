"""One task's results as a grid: means over folds and troubles by case, label and metric."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd

from mocapbench.metrics.statistics import SharedRank, shared_rank
from mocapbench.reports.analysis.fold_mean import FoldMean
from mocapbench.reports.analysis.troubles import Trouble, troubles
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.layout import CaseLayout, TaskLayout
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.paper.published import PublishedTask, PublishedValue, published_values

__all__ = ["TaskResults", "task_results"]


@dataclass(frozen=True, eq=False)
class TaskResults:
    """The results of one task.

    Parameters
    ----------
    layout : TaskLayout
    metrics : mapping of str to MetricInfo
    scores, records : DataFrame
        The task's rows of the bundle's tables, without scores that are not finite.
    estimates : mapping of (case, label, metric) to FoldMean
    troubles : mapping of (case, label) to tuple of Trouble
        Jobs that failed or whose data are missing.
    published : mapping of (case, metric, model) to PublishedValue
        In the paper's names.
    """

    layout: TaskLayout
    metrics: Mapping[str, MetricInfo]
    scores: pd.DataFrame
    records: pd.DataFrame
    estimates: Mapping[tuple[str, str, str], FoldMean]
    troubles: Mapping[tuple[str, str], tuple[Trouble, ...]]
    published: PublishedTask

    @cached_property
    def cases(self) -> tuple[CaseLayout, ...]:
        """The cases that ran, in table order."""
        ran = set(self.records["case"])
        return tuple(case for case in self.layout.cases if case.name in ran)

    def estimate(self, case: str, label: str, metric: str) -> FoldMean | None:
        """Return the mean over folds, or None where the label has no score."""
        return self.estimates.get((case, label, metric))

    def published_value(self, case: CaseLayout, label: str, metric: str) -> PublishedValue | None:
        """Return the published counterpart of our estimate, or None where there is none."""
        page = self.layout.page
        row, name = case.notes.published or "", page.published_metrics.get(metric, "")
        return self.published.get((row, name, page.published_models.get(label, "")))

    def ranking(self, case: str, metric: str) -> list[str]:
        """Return the competing labels that have a score, best first; ties in table order.

        An entrant that lacks a fold comes after all entrants that have every fold. Its mean covers
        only the folds that it finished, which may be the easy ones.
        """
        estimates = {label: self.estimate(case, label, metric) for label in self.layout.ranked}
        scored = {label: mean for label, mean in estimates.items() if mean is not None}
        most = max((estimate.n for estimate in scored.values()), default=0)
        loss = self.metrics[metric].loss
        return sorted(scored, key=lambda name: (scored[name].n < most, loss(scored[name].mean)))

    @cached_property
    def values(self) -> Mapping[str, pd.DataFrame]:
        """By metric, the scores by (case, fold), one column per label, NaN where there is none."""
        return {
            str(metric): rows.pivot(index=["case", "fold"], columns="label", values="value")
            for metric, rows in self.scores.groupby("metric", sort=False)
        }

    @cached_property
    def representative_values(self) -> Mapping[str, pd.DataFrame]:
        """The `values` of the representative cases."""
        cases = {m: [case.name for case in self.representative_cases(m)] for m in self.values}
        return {
            metric: values[values.index.get_level_values("case").isin(cases[metric])]
            for metric, values in self.values.items()
        }

    def first_rank(self, case: str, metric: str) -> SharedRank | None:
        """Return the entrants that share the first rank of a row, by a paired test.

        Returns
        -------
        SharedRank or None
            None where no entrant has a score.
        """
        return self._first_ranks.get((case, metric))

    @cached_property
    def _first_ranks(self) -> Mapping[tuple[str, str], SharedRank | None]:
        rows = {(case, metric): None for case, _, metric in self.estimates}
        return {row: self._first_rank(*row) for row in rows}

    def _first_rank(self, case: str, metric: str) -> SharedRank | None:
        order = tuple(self.ranking(case, metric))
        if not order:
            return None
        units = self.values[metric].loc[[case], list(order)]
        if not self.layout.independent_folds:
            units = units.groupby(level="case").mean()
        return shared_rank(units.map(self.metrics[metric].loss), order)

    def best(self, case: str, metric: str) -> set[str]:
        """Return the labels of the first rank: the best mean, and all not separable from it."""
        rank = self.first_rank(case, metric)
        return set(rank.labels) if rank else set()

    def representative_cases(self, metric: str) -> list[CaseLayout]:
        """Return the cases with scores that enter counts, ranks and means over cases.

        Generated motion enters only where there are no recordings. A row that averages over
        references enters only where the rows of those references are missing.
        """
        scored = [case for case in self.cases if self.ranking(case.name, metric)]
        recorded = [case for case in scored if not case.synthetic] or scored
        return [case for case in recorded if not case.averages_references] or recorded


def task_results(bundle: Bundle, layout: TaskLayout) -> TaskResults:
    """Return the results of the task that ``layout`` describes."""
    scores = bundle.scores[bundle.scores["task"] == layout.name]
    scores = scores[np.isfinite(scores["value"].to_numpy(float))].sort_values("fold", kind="stable")
    groups = scores.groupby(["case", "label", "metric"], sort=False)
    return TaskResults(
        layout=layout,
        metrics=bundle.metrics,
        scores=scores,
        records=bundle.records[bundle.records["task"] == layout.name],
        estimates={
            key: FoldMean.of(group["value"].to_list(), group["sample_two_sd"].to_list())
            for key, group in groups
        },
        troubles=_troubles_by_cell(bundle, layout.name),
        published=published_values(layout.name),
    )


def _troubles_by_cell(bundle: Bundle, task: str) -> dict[tuple[str, str], tuple[Trouble, ...]]:
    """Return the troubles of ``task`` by (case, label)."""
    by_cell: dict[tuple[str, str], tuple[Trouble, ...]] = {}
    for trouble in troubles(bundle):
        if trouble.task == task:
            cell = (trouble.case, trouble.label)
            by_cell[cell] = (*by_cell.get(cell, ()), trouble)
    return by_cell
