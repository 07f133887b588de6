"""Mean ranks of entrants over the cases of a task, and over tasks."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np
import pandas as pd
from scipy import stats

from mocapbench.metrics.statistics import RankComparison, compare_ranks
from mocapbench.reports.analysis.results import TaskResults

__all__ = ["Ranks", "case_losses", "ranks_over_cases", "ranks_over_tasks"]

FEWEST_ENTRANTS, FEWEST_BLOCKS = 3, 2


@dataclass(frozen=True)
class Ranks:
    """Compared ranks, by label.

    Parameters
    ----------
    labels : tuple of str
        Entrants with a score in every block, in table order.
    left_out : tuple of str
        Entrants with a score in some blocks but not in all.
    blocks : str
        What the entrants are ranked over: ``"cases"`` or ``"tasks"``.
    comparison : RankComparison
    """

    labels: tuple[str, ...]
    left_out: tuple[str, ...]
    blocks: str
    comparison: RankComparison


def ranks_over_cases(results: TaskResults, metric: str) -> Ranks | None:
    """Return the ranks over the representative cases of a task; None where there are too few.

    Each case counts once, by the means over its folds.
    """
    return _ranks(case_losses(results, metric), "cases")


def ranks_over_tasks(tasks: Iterable[TaskResults]) -> Ranks | None:
    """Return the ranks over tasks, each by its first metric; None where there are too few.

    Each task counts once, by the mean ranks over its cases of the entrants that all tasks share.
    """
    losses = [case_losses(task, task.layout.page.metrics[0]) for task in tasks]
    losses = [table for table in losses if not table.empty]
    if len(losses) < FEWEST_BLOCKS:
        return None
    common = reduce(pd.Index.intersection, [table.dropna(axis=1).columns for table in losses])
    ranked = [stats.rankdata(table[common], axis=1).mean(axis=0) for table in losses]
    entered = list(dict.fromkeys(label for table in losses for label in table.columns))
    return _ranks(pd.DataFrame(ranked, columns=common).reindex(columns=entered), "tasks")


def case_losses(results: TaskResults, metric: str) -> pd.DataFrame:
    """Return the losses of the entrants' means.

    Returns
    -------
    DataFrame
        One row per representative case and one column per entrant with a score; NaN where an
        entrant has no score in a case.
    """
    loss = results.metrics[metric].loss
    cases = [case.name for case in results.representative_cases(metric)]
    table = {
        label: [
            loss(estimate.mean) if (estimate := results.estimate(case, label, metric)) else np.nan
            for case in cases
        ]
        for label in results.layout.ranked
    }
    return pd.DataFrame(table, index=cases).dropna(axis=1, how="all")


def _ranks(losses: pd.DataFrame, blocks: str) -> Ranks | None:
    whole = losses.dropna(axis=1)
    if len(whole) < FEWEST_BLOCKS or len(whole.columns) < FEWEST_ENTRANTS:
        return None
    left_out = [label for label in losses.columns if label not in whole.columns]
    return Ranks(
        _names(whole.columns), _names(left_out), blocks, compare_ranks(whole.to_numpy(float))
    )


def _names(labels: Sequence[str] | pd.Index[str]) -> tuple[str, ...]:
    return tuple(map(str, labels))
