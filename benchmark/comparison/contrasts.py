"""Two sides of paired records, contrasted per task, case and metric, and over a task's cases.

A side is a run, or a model within a run. What is paired is the same problem: task and version,
case, fold, seed and recordings. Anything else is refused, because a difference between problems
would pass for one between the sides.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace

import pandas as pd

from mocapbench.benchmark.comparison.problems import require_same_problems
from mocapbench.benchmark.comparison.sides import Side
from mocapbench.benchmark.comparison.units import units_of, with_advantages
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.results.bundle import metric_info
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import Task
from mocapbench.metrics.statistics import Contrast, contrast, holm, pair

__all__ = ["POOLED", "Row", "compare", "tidy"]

POOLED = "all cases"


@dataclass(frozen=True)
class Row:
    """One contrast: of one case, or of all cases of a task (`POOLED`).

    ``identical`` says whether both sides have the same value in every fold.
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
    one, other = (_scored(side, tasks) for side in (first, second))
    common = [address for address in one if address in other]
    if not common:
        raise UsageError("compare: the two have no scored (task, case, fold, entrant) in common")
    require_same_problems([(one[address], other[address]) for address in common])
    names = list(dict.fromkeys(address.task for address in common))
    chosen = list(dict.fromkeys(map(METRICS.current_name, metrics)))
    rows = [
        row
        for task in map(TASKS.get, names)
        for metric in chosen or task.page.metrics
        for row in _rows(task, metric, _pairs(task, metric, one, other), rope)
    ]
    if not rows:
        raise UsageError(f"compare: the two have no value of {', '.join(metrics)} in common")
    return rows


def _scored(side: Side, tasks: Sequence[str]) -> dict[Address, Record]:
    """Return the records with scores by address, whose version `differences` compares."""
    return {
        record.address._replace(version=0): record
        for record in side
        if record.status is Status.OK and (not tasks or record.address.task in tasks)
    }


def _pairs(
    task: Task, metric: str, one: Mapping[Address, Record], other: Mapping[Address, Record]
) -> dict[str, pd.DataFrame]:
    """Return the paired values of each entrant of a task."""
    common = (address for address in one if address in other)
    labels = dict.fromkeys(address.label for address in common if address.task == task.name)
    return {
        label: pair(*(_values(side, task, label, metric) for side in (one, other)))
        for label in labels
    }


def _values(
    side: Mapping[Address, Record], task: Task, label: str, metric: str
) -> pd.Series[float]:
    values = {
        (address.case, address.fold): record.scores.get(metric, math.nan)
        for address, record in side.items()
        if (address.task, address.label) == (task.name, label)
    }
    index = pd.MultiIndex.from_tuples(list(values), names=["case", "fold"])
    return pd.Series(list(values.values()), index, dtype=float)


def _rows(task: Task, metric: str, pairs: Mapping[str, pd.DataFrame], rope: float) -> list[Row]:
    advantages = {label: with_advantages(own, metric_info(metric)) for label, own in pairs.items()}

    def row(label: str, case: str, own: pd.DataFrame) -> Row:
        found = contrast(units_of(task, own), rope)
        return Row(task.name, metric, label, case, found, own["first"].equals(own["second"]))

    single = [
        row(label, str(case), of_case)
        for label, own in advantages.items()
        for case, of_case in own.groupby(level="case", sort=False)
    ]
    pooled = [
        row(label, POOLED, counted)
        for label, own in advantages.items()
        for counted in [_counted(task, own)]
        if counted.index.unique("case").size > 1
    ]
    return [*_corrected(single), *_corrected(pooled)]


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


def tidy(rows: Iterable[Row]) -> pd.DataFrame:
    """Return one line per contrast, unrounded."""
    lines = []
    for row in rows:
        line = asdict(row)
        lines.append({**{k: v for k, v in line.items() if k != "contrast"}, **line["contrast"]})
    return pd.DataFrame(lines)
