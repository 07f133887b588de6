"""One task's results: scores, means over folds and failures by case, label and metric."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Array
from mocapbench.reports.analysis.estimates import FoldMean, estimates, fold_table
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.layout import CaseLayout, TaskLayout
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.paper.published import PublishedTask, PublishedValue, published_values
from mocapbench.reports.text import decimals

__all__ = ["DATA_MISSING", "TaskResults", "list_failures", "task_results"]

DATA_MISSING = "data-missing"


@dataclass(frozen=True, eq=False)
class TaskResults:
    """The results of one task.

    Parameters
    ----------
    layout : TaskLayout
    metrics : mapping of str to MetricInfo
    scores, records : DataFrame
        The task's rows of the bundle's tables, without scores that are not finite.
    folds : DataFrame
        The scores by metric, label and case, with a column a fold.
    estimates : mapping of (case, label, metric) to FoldMean
    failures : mapping of (case, label) to sequence of rows
        Jobs that failed, be it by one metric alone, or whose data are missing: rows of
        `list_failures`.
    published : mapping of (case, metric, model) to PublishedValue
        In the paper's names.
    """

    layout: TaskLayout
    metrics: Mapping[str, MetricInfo]
    scores: pd.DataFrame
    records: pd.DataFrame
    folds: pd.DataFrame
    estimates: Mapping[tuple[str, str, str], FoldMean]
    failures: Mapping[tuple[str, str], Sequence[Any]]
    published: PublishedTask

    @cached_property
    def cases(self) -> tuple[CaseLayout, ...]:
        """The cases that ran, in table order."""
        ran = set(pd.unique(self.records["case"]))
        return tuple(case for case in self.layout.cases if case.name in ran)

    def values(self, metric: str, labels: Sequence[str], cases: Sequence[str]) -> Array:
        """Return the scores of ``metric``, of shape (n_labels, n_cases, n_folds); NaN of none."""
        wanted = pd.MultiIndex.from_product([[metric], labels, cases])
        values = self.folds.reindex(wanted).to_numpy()
        return values.reshape(len(labels), len(cases), values.shape[1])

    @cached_property
    def fold_numbers(self) -> list[int]:
        """The folds of the task that have scores, in ascending order."""
        return [*map(int, self.folds.columns)]

    @cached_property
    def without_data(self) -> frozenset[str]:
        """The names of the cases of which no job could run for lack of its recordings."""
        statuses: dict[str, set[str]] = {}
        columns = (self.records[name].tolist() for name in ("case", "status"))
        for case, status in zip(*columns, strict=True):
            statuses.setdefault(case, set()).add(status)
        return frozenset(case for case, found in statuses.items() if found == {DATA_MISSING})

    @cached_property
    def decimals(self) -> Mapping[str, int]:
        """With how many decimals the means of each metric are shown."""
        means: dict[str, list[float]] = {}
        for (_, _, metric), estimate in self.estimates.items():
            means.setdefault(metric, []).append(estimate.mean)
        return {metric: decimals(values) for metric, values in means.items()}

    def find_failures(self, case: str, label: str, metric: str) -> list[Any]:
        """Return the failures that cost a score of ``metric``: another may be what failed."""
        folds = self.values_by_fold(case, label, metric)
        found = self.failures.get((case, label), ())
        return [failure for failure in found if failure.fold not in folds]

    def values_by_fold(self, case: str, label: str, metric: str) -> Mapping[int, float]:
        """Return the scores of a metric by fold, without folds that have none."""
        row = self._values.get((metric, label, case), ())
        values = zip(self.fold_numbers, row, strict=False)
        return {fold: float(value) for fold, value in values if np.isfinite(value)}

    @cached_property
    def _values(self) -> Mapping[tuple[str, str, str], Array]:
        """The rows of ``folds``; a number of each score is all that they take."""
        return dict(zip(self.folds.index, self.folds.to_numpy(), strict=True))

    def estimate(self, case: str, label: str, metric: str) -> FoldMean | None:
        """Return the mean over folds, or None where the label has no score."""
        return self.estimates.get((case, label, metric))

    def case_means(self, metric: str, label: str) -> list[float]:
        """Return the mean of each case that enters means over cases and has a score."""
        cases = self.representative_cases(metric)
        found = [self.estimate(case.name, label, metric) for case in cases]
        return [estimate.mean for estimate in found if estimate is not None]

    def published_value(self, case: CaseLayout, label: str, metric: str) -> PublishedValue | None:
        """Return the published counterpart of our estimate, or None where there is none."""
        page = self.layout.page
        row, name = page.published_rows.get(case.name, ""), page.published_metrics.get(metric, "")
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

    def best_label(self, case: str, metric: str) -> str | None:
        """Return the competing label with the best mean, or None where no label has a score."""
        return next(iter(self.ranking(case, metric)), None)

    def representative_cases(self, metric: str) -> list[CaseLayout]:
        """Return the cases with scores that enter counts, ranks and means over cases.

        Generated motion enters only where there are no recordings. A row that averages over
        references enters only where the rows of those references are missing.
        """
        ranked = self.layout.ranked
        scored = [
            case
            for case in self.cases
            if any((case.name, label, metric) in self.estimates for label in ranked)
        ]
        recorded = [case for case in scored if not case.synthetic] or scored
        return [case for case in recorded if not case.averages_references] or recorded


def task_results(bundle: Bundle, layout: TaskLayout) -> TaskResults:
    """Return the results of the task that ``layout`` describes."""
    scores = bundle.scores[bundle.scores["task"] == layout.name]
    scores = scores[np.isfinite(scores["value"].to_numpy(float))].sort_values("fold", kind="stable")
    return TaskResults(
        layout=layout,
        metrics=bundle.metrics,
        scores=scores,
        records=bundle.records[bundle.records["task"] == layout.name],
        folds=fold_table(scores, "value"),
        estimates=estimates(scores, layout.cases, independent=layout.independent_folds),
        failures=_group_failures(list_failures(bundle, layout.name)),
        published=published_values(layout.name),
    )


def list_failures(bundle: Bundle, task: str | None = None) -> pd.DataFrame:
    """Return the jobs that did not end well, of one task or all, in the order of the records.

    Returns
    -------
    DataFrame
        Columns ``id``, the anchor of its entry on the page, ``task``, ``case``, ``fold``,
        ``label``, ``status``, ``message``, ``traceback``, ``missing``, the names of recordings
        that it lacked, and ``fetch``, the command that gets them. A job that lost a metric alone
        has the scores of the others.
    """
    texts = ["task", "case", "label", "status", "message", "traceback", "missing", "fetch"]
    lost = bundle.records[bundle.records["status"] != "ok"].reindex(columns=["fold", *texts])
    lost[texts] = lost[texts].astype(object).where(lost[texts].notna(), "")
    lost["missing"] = lost["missing"].map(shlex.split)
    lost["id"] = [f"job-{number}" for number in range(1, len(lost) + 1)]
    return lost if task is None else lost[lost["task"] == task]


def _group_failures(failures: pd.DataFrame) -> dict[tuple[str, str], list[Any]]:
    by_cell: dict[Any, list[Any]] = {}
    for failure in failures.itertuples():
        by_cell.setdefault((failure.case, failure.label), []).append(failure)
    return by_cell
