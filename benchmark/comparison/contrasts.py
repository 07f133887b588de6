"""Two sides of paired records, contrasted per task, case and metric, and over a task's cases.

A side is a run, or a model within a run. What is paired is the same problem: task and version,
case, fold, seed and recordings. Anything else is refused, because a difference between problems
would pass for one between the sides. A side that lost a fold of a row is not tested there: the
folds in which it succeeded may be the easy ones.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import pandas as pd

from mocapbench.benchmark.comparison.folds import asked, both_ok, paired_folds
from mocapbench.benchmark.comparison.problems import require_same_problems
from mocapbench.benchmark.comparison.sides import Side
from mocapbench.benchmark.comparison.units import units_of, with_advantages
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.results.bundle import metric_info
from mocapbench.benchmark.tasks.base import Task
from mocapbench.metrics.statistics import Contrast, contrast, holm
from mocapbench.reports import MetricInfo

__all__ = ["POOLED", "Row", "compare"]

POOLED = "all cases"


@dataclass(frozen=True)
class Row:
    """One contrast: of one case, or of all cases of a task (`POOLED`).

    ``identical`` says whether both sides have the same value in every fold. Of ``folds`` that both
    were asked for, they lost ``first_lost`` and ``second_lost``; if any, there are means alone.
    ``t_p_holm`` and ``signed_rank_p_holm`` are corrected over the rows of one task and metric,
    the pooled ones apart from those of single cases.
    """

    task: str
    metric: str
    entrant: str
    case: str
    contrast: Contrast
    identical: bool = False
    t_p_holm: float = math.nan
    signed_rank_p_holm: float = math.nan
    folds: int = 0
    first_lost: int = 0
    second_lost: int = 0

    @property
    def incomplete(self) -> bool:
        """Whether a side lost folds."""
        return self.first_lost + self.second_lost > 0


def compare(
    first: Side,
    second: Side,
    *,
    tasks: Sequence[str] = (),
    metrics: Sequence[str] = (),
    rope: float,
) -> list[Row]:
    """Return every contrast of two sides, by task, metric, entrant and case, in table order.

    Parameters
    ----------
    first, second : sequence of Record
    tasks, metrics : sequence of str
        Names; by default every task, and the metrics that its tables show.
    rope : float
        Half the region of practical equivalence, as a share of the mean value.

    Raises
    ------
    UsageError
        If nothing is in common, or what has one address is not the same problem.
    """
    one, other = (asked(side, tasks) for side in (first, second))
    common = {address: (one[address], other[address]) for address in one if address in other}
    if not common:
        raise UsageError("compare: the two have no scored (task, case, fold, entrant) in common")
    require_same_problems(list(filter(both_ok, common.values())))
    names = list(dict.fromkeys(address.task for address in common))
    chosen = list(dict.fromkeys(map(METRICS.current_name, metrics)))
    rows = [
        row
        for task in map(TASKS.get, names)
        for metric in chosen or task.page.metrics
        for row in _rows(task, metric, paired_folds(task.name, metric, common), rope)
    ]
    if not rows:
        raise UsageError(f"compare: the two have no value of {', '.join(metrics)} in common")
    return rows


def _rows(task: Task, metric: str, folds: Mapping[str, pd.DataFrame], rope: float) -> list[Row]:
    def row(label: str, case: str, own: pd.DataFrame) -> Row:
        found = _contrast(task, metric_info(metric), own.dropna(), rope)
        return _counting(own, Row(task.name, metric, label, case, found))

    single = [
        row(label, str(case), of_case)
        for label, own in folds.items()
        for case, of_case in own.groupby(level="case", sort=False)
    ]
    pooled = [
        row(label, POOLED, counted)
        for label, own in folds.items()
        for counted in [_counted(task, own)]
        if counted.index.unique("case").size > 1
    ]
    return [*_corrected(single), *_corrected(pooled)]


def _contrast(task: Task, metric: MetricInfo, pairs: pd.DataFrame, rope: float) -> Contrast:
    if pairs.empty:
        return Contrast(0)
    return contrast(units_of(task, with_advantages(pairs, metric)), rope)


def _counting(folds: pd.DataFrame, row: Row) -> Row:
    """Return the row with the folds that it is of; with means alone, if some of them are lost."""
    first, second = map(int, folds.isna().sum())
    counted = replace(row, folds=len(folds), first_lost=first, second_lost=second)
    if counted.incomplete:
        means = Contrast(row.contrast.n, row.contrast.first, row.contrast.second)
        return replace(counted, contrast=means)
    return replace(counted, identical=folds["first"].equals(folds["second"]))


def _counted(task: Task, pairs: pd.DataFrame) -> pd.DataFrame:
    """Return the pairs that count over cases, by the rule that the report's tables follow."""
    generated = [case.name for case in task.cases if case.synthetic]
    averages = [case.name for case in task.cases if task.averages_references(case)]
    for apart in (generated, averages):
        others = pairs[~pairs.index.get_level_values("case").isin(apart)]
        pairs = pairs if others.empty else others
    return pairs


def _corrected(rows: Sequence[Row]) -> list[Row]:
    t, signed = (
        holm([getattr(row.contrast, test) for row in rows]) for test in ("t_p", "signed_rank_p")
    )
    return [
        replace(row, t_p_holm=float(one), signed_rank_p_holm=float(other))
        for row, one, other in zip(rows, t, signed, strict=True)
    ]
