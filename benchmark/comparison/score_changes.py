"""The scores of one cell in two runs, and whether they differ by more than the noise of folds.

Runs are paired fold by fold. The differences over the folds of a cell are tested by the paired
t-test, with Holm's correction over the scores of one task and metric that changed at all: a score
that is the same to the last digit needs no test.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.tasks.base import Task
from mocapbench.metrics.statistics import ALPHA, holm, mean_interval, t_test
from mocapbench.reports import ChangeVerdict, ScoreChange

__all__ = ["Pair", "score_changes"]

Pair = tuple[Record, Record]
"""The records of one job in both runs, which solve the same problem and have scores."""

Cell = tuple[str, str]
Folds = NDArray[np.float64]


def score_changes(pairs: Iterable[Pair]) -> list[ScoreChange]:
    """Return every metric that the tables show of every cell, by task and metric.

    Parameters
    ----------
    pairs : iterable of Pair
    """
    tasks: dict[str, dict[Cell, list[Pair]]] = {}
    for pair in pairs:
        address = pair[0].address
        cells = tasks.setdefault(address.task, {})
        cells.setdefault((address.case, address.label), []).append(pair)
    return [
        change
        for name, cells in tasks.items()
        for task in [TASKS.get(name)]
        for metric in task.page.metrics
        for change in _changes(task, metric, cells)
    ]


def _changes(task: Task, metric: str, cells: Mapping[Cell, Sequence[Pair]]) -> list[ScoreChange]:
    values = {cell: _values(pairs, metric) for cell, pairs in cells.items()}
    compared = {cell: folds for cell, folds in values.items() if len(folds)}
    p_values = holm([_p_value(task, metric, folds) for folds in compared.values()])
    return [
        _change(task, metric, cell, folds, p)
        for (cell, folds), p in zip(compared.items(), p_values, strict=True)
    ]


def _values(pairs: Sequence[Pair], metric: str) -> Folds:
    """Return the finite values that both runs have, a row a fold."""
    both = [[record.scores.get(metric, np.nan) for record in pair] for pair in pairs]
    values = np.array(both, dtype=float).reshape(-1, 2)
    return values[np.isfinite(values).all(axis=1)]


def _p_value(task: Task, metric: str, folds: Folds) -> float:
    """Return p of the paired t-test; NaN where nothing changed or one unit allows no test."""
    return np.nan if _same(folds) else t_test(_advantages(task, metric, folds))


def _same(folds: Folds) -> bool:
    return np.array_equal(folds[:, 0], folds[:, 1])


def _advantages(task: Task, metric: str, folds: Folds) -> NDArray[np.float64]:
    """Return by how much the second run is better, a unit each.

    Folds are units where they are independent draws; else their mean is the only unit.
    """
    loss = np.vectorize(METRICS.get(metric).loss, otypes=[float])
    advantages = loss(folds[:, 0]) - loss(folds[:, 1])
    return advantages if task.independent_folds else advantages.mean(keepdims=True)


def _change(task: Task, metric: str, cell: Cell, folds: Folds, p: float) -> ScoreChange:
    advantages = _advantages(task, metric, folds)
    first, second = (float(mean) for mean in folds.mean(axis=0))
    interval = mean_interval(advantages)
    verdict = _verdict(folds, p, better=float(advantages.mean()) > 0.0)
    return ScoreChange(task.name, *cell, metric, len(folds), first, second, *interval, verdict)


def _verdict(folds: Folds, p: float, *, better: bool) -> ChangeVerdict:
    if _same(folds):
        return ChangeVerdict.IDENTICAL
    if np.isnan(p):
        return ChangeVerdict.UNTESTED
    if p > ALPHA:
        return ChangeVerdict.WITHIN_NOISE
    return ChangeVerdict.BETTER if better else ChangeVerdict.WORSE
