"""Two sides of paired records, contrasted per task, case and metric, and over a task's cases.

A side is a run, or a model within a run. What is paired is the same problem: task and version,
case, fold, seed and recordings. Anything else is refused, because a difference between problems
would pass for one between the sides.
"""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.benchmark.comparison.folds import both_scored, paired_folds, records_by_address
from mocapbench.benchmark.comparison.problems import require_same_problems
from mocapbench.benchmark.comparison.rows import Row, case_rows, correct_rows, pooled_rows
from mocapbench.benchmark.comparison.sides import Side
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.results.shown_metrics import shown_metrics

__all__ = ["compare"]


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
    one, other = (records_by_address(side, tasks) for side in (first, second))
    common = {address: (one[address], other[address]) for address in one if address in other}
    if not common:
        raise UsageError("compare: the two have no scored (task, case, fold, entrant) in common")
    require_same_problems(list(filter(both_scored, common.values())))
    names = list(dict.fromkeys(address.task for address in common))
    chosen = list(dict.fromkeys(metrics))
    rows = [
        row
        for task in map(TASKS.get, names)
        for metric in chosen or shown_metrics(task, one.values())
        for folds in [paired_folds(task.name, metric, common)]
        for found in (case_rows, pooled_rows)
        for row in correct_rows(found(task, metric, folds, rope))
    ]
    if not rows:
        raise UsageError(f"compare: the two have no value of {', '.join(metrics)} in common")
    return rows
