"""The scores of one cell in two runs, and whether they differ by more than chance.

Folds are paired, and units tested, as `mocapbench compare` does it. Holm's correction is over the
scores of one task and metric that changed at all: a score that is the same to the last digit needs
no test.
"""

from __future__ import annotations

from collections.abc import Mapping

from mocapbench.benchmark.comparison.folds import Pair, paired_folds
from mocapbench.benchmark.comparison.rows import Row, case_rows, correct_rows
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.results.shown_metrics import shown_metrics
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import Task
from mocapbench.reports import ScoreChange

__all__ = ["score_changes"]


def score_changes(common: Mapping[Address, Pair]) -> list[ScoreChange]:
    """Return every metric that the tables show of every cell, by task and metric, changed first.

    Parameters
    ----------
    common : mapping of Address to pair of Record
        The jobs that both runs were asked for; two with scores solve the same problem.
    """
    names = dict.fromkeys(address.task for address in common)
    return [
        change
        for task in map(TASKS.get, names)
        for metric in shown_metrics(task, (one for one, _ in common.values()))
        for change in _changes(task, metric, common)
    ]


def _changes(task: Task, metric: str, common: Mapping[Address, Pair]) -> list[ScoreChange]:
    rows = case_rows(task, metric, paired_folds(task.name, metric, common))
    identical = [row for row in rows if row.identical]
    changed = correct_rows([row for row in rows if not row.identical])
    return [_change(row) for row in (*changed, *identical) if row.contrast.n]


def _change(row: Row) -> ScoreChange:
    found = row.contrast
    return ScoreChange(
        task=row.task,
        case=row.case,
        label=row.entrant,
        metric=row.metric,
        n=found.n,
        first=found.first,
        second=found.second,
        low=-found.high,
        high=-found.low,
        verdict=row.verdict,
    )
