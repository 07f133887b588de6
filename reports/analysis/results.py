"""One task's results as a grid: estimates and troubles by case, label and metric."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd
from scipy import stats

from mocapbench.metrics.statistics import SharedRank, shared_rank
from mocapbench.reports.bundle.bundle import Bundle, CaseLayout, MetricInfo, TaskLayout
from mocapbench.reports.paper.published import PublishedTask, PublishedValue, published_values

__all__ = ["Estimate", "TaskResults", "Trouble", "task_results", "troubles"]

DATA_MISSING = "data-missing"


@dataclass(frozen=True)
class Estimate:
    """A mean over folds.

    Parameters
    ----------
    mean : float
    two_sd : float or None
        Two standard deviations (ddof 1) over folds; None for a single fold.
    n : int
        Number of folds.
    sample_two_sd : float or None
        Two standard deviations (ddof 1) over the samples of a fold, averaged over folds; None
        where the values are not means over samples.
    """

    mean: float
    two_sd: float | None
    n: int
    sample_two_sd: float | None = None

    @classmethod
    def of(cls, values: Sequence[float], sample_two_sds: Sequence[float] = ()) -> Estimate:
        """Return the estimate of one or more finite values, one a fold.

        ``sample_two_sds`` are those of each value over its samples, NaN where it has none.
        """
        two_sd = 2.0 * float(np.std(values, ddof=1)) if len(values) > 1 else None
        within = [each for each in sample_two_sds if math.isfinite(each)]
        sample_two_sd = float(np.mean(within)) if within else None
        return cls(float(np.mean(values)), two_sd, len(values), sample_two_sd)

    @property
    def spread(self) -> float | None:
        """What stands behind ± in tables: that over samples where there is one, else over folds."""
        return self.two_sd if self.sample_two_sd is None else self.sample_two_sd

    @property
    def half_width(self) -> float | None:
        """Half the 95 % interval of the mean by Student's t; None for a single fold.

        It takes the folds for independent draws.
        """
        if self.two_sd is None:
            return None
        quantile = float(stats.t.ppf(0.975, self.n - 1))
        return quantile * 0.5 * self.two_sd / math.sqrt(self.n)


@dataclass(frozen=True)
class Trouble:
    """A job that gave no score; ``id`` is its place in the page."""

    id: str
    task: str
    case: str
    fold: int
    label: str
    status: str
    message: str
    traceback: str


@dataclass(frozen=True, eq=False)
class TaskResults:
    """What is known of one task.

    Parameters
    ----------
    layout : TaskLayout
    metrics : mapping of str to MetricInfo
    scores, records : DataFrame
        The task's rows of the bundle's tables; scores that are not finite are left out.
    estimates : mapping of (case, label, metric) to Estimate
    troubles : mapping of (case, label) to tuple of Trouble
        Jobs that failed or whose data are missing.
    published : mapping of (case, metric, model) to PublishedValue
        In the paper's names.
    """

    layout: TaskLayout
    metrics: Mapping[str, MetricInfo]
    scores: pd.DataFrame
    records: pd.DataFrame
    estimates: Mapping[tuple[str, str, str], Estimate]
    troubles: Mapping[tuple[str, str], tuple[Trouble, ...]]
    published: PublishedTask

    @property
    def cases(self) -> tuple[CaseLayout, ...]:
        """The cases that ran, in table order."""
        ran = set(self.records["case"])
        return tuple(case for case in self.layout.cases if case.name in ran)

    def estimate(self, case: str, label: str, metric: str) -> Estimate | None:
        """Return the estimate, or None where the label has no score there."""
        return self.estimates.get((case, label, metric))

    def printed(self, case: CaseLayout, label: str, metric: str) -> PublishedValue | None:
        """Return the published value that stands beside ours, or None where there is none."""
        model = self.layout.published_models.get(label, "")
        return self.published.get(
            (case.published or "", self.layout.published_metrics.get(metric, ""), model)
        )

    def ranking(self, case: str, metric: str) -> list[str]:
        """Return the competing labels that have a score, best first; ties in table order.

        Who lacks a fold that others have comes after all who do not: the mean of the folds that it
        survived, which may be the easy ones, must not lead.
        """
        found = {label: self.estimate(case, label, metric) for label in self.layout.ranked}
        scored = {label: estimate for label, estimate in found.items() if estimate is not None}
        most = max((estimate.n for estimate in scored.values()), default=0)
        loss = self.metrics[metric].loss
        return sorted(scored, key=lambda name: (scored[name].n < most, loss(scored[name].mean)))

    @cached_property
    def values(self) -> Mapping[str, pd.DataFrame]:
        """By metric, the scores by (case, fold), one column per label, NaN where there is none."""
        return {
            str(metric): own.pivot(index=["case", "fold"], columns="label", values="value")
            for metric, own in self.scores.groupby("metric", sort=False)
        }

    def first_rank(self, case: str, metric: str) -> SharedRank | None:
        """Return who shares the first rank of a row, by test; None where nobody has a score."""
        order = tuple(self.ranking(case, metric))
        if not order:
            return None
        units = self.values[metric].loc[[case], list(order)]
        if not self.layout.independent_folds:
            units = units.groupby(level="case").mean()
        return shared_rank(units.map(self.metrics[metric].loss), order)

    def best(self, case: str, metric: str) -> set[str]:
        """Return the labels of the first rank: those that no test tells from the best mean."""
        rank = self.first_rank(case, metric)
        return set(rank.labels) if rank else set()

    def judged(self, metric: str) -> list[CaseLayout]:
        """Return the cases with scores that count over cases.

        Generated motion, and rows that pool others, count only where there is nothing else.
        """
        scored = [case for case in self.cases if self.ranking(case.name, metric)]
        recorded = [case for case in scored if not case.synthetic] or scored
        return [case for case in recorded if not case.pooled] or recorded


def task_results(bundle: Bundle, layout: TaskLayout) -> TaskResults:
    """Return the results of the task that ``layout`` describes."""
    scores = bundle.scores[bundle.scores["task"] == layout.name]
    scores = scores[np.isfinite(scores["value"].to_numpy(float))].sort_values("fold", kind="stable")
    groups = scores.groupby(["case", "label", "metric"], sort=False)
    by_address: dict[tuple[str, str], tuple[Trouble, ...]] = {}
    for trouble in troubles(bundle):
        if trouble.task == layout.name:
            address = (trouble.case, trouble.label)
            by_address[address] = (*by_address.get(address, ()), trouble)
    return TaskResults(
        layout=layout,
        metrics=bundle.metrics,
        scores=scores,
        records=bundle.records[bundle.records["task"] == layout.name],
        estimates={
            key: Estimate.of(group["value"].to_list(), group["sample_two_sd"].to_list())
            for key, group in groups
        },
        troubles=by_address,
        published=published_values(layout.name),
    )


def troubles(bundle: Bundle) -> tuple[Trouble, ...]:
    """Return every job without a score, in the order of the records."""
    rows = bundle.records[bundle.records["status"] != "ok"]
    return tuple(
        Trouble(
            id=f"job-{number}",
            fold=int(row["fold"]),
            **{
                field: "" if pd.isna(row[field]) else str(row[field])
                for field in ("task", "case", "label", "status", "message", "traceback")
            },
        )
        for number, row in enumerate(rows.to_dict("records"), start=1)
    )
