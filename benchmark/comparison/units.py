"""The units of a comparison and their advantages, by the rules of the report.

`mocapbench.reports.analysis.units` states what a unit is: a person, where cases or folds go through
recordings of people. `MetricInfo.linear_losses` states the loss of a fold.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench.benchmark.tasks.base import Task
from mocapbench.reports import CaseLayout, MetricInfo
from mocapbench.reports.analysis.units import unit_names, unit_weights

__all__ = ["units_of", "with_advantages"]


def with_advantages(pairs: pd.DataFrame, metric: MetricInfo) -> pd.DataFrame:
    """Return pairs with the ``advantage`` of the first, which is positive where it is better.

    Parameters
    ----------
    pairs : DataFrame
        Columns ``first`` and ``second``, indexed by (case, fold).
    metric : MetricInfo
    """
    advantages = np.zeros(len(pairs))
    for places in pairs.groupby(level="case", sort=False).indices.values():
        first, second = metric.linear_losses(pairs.to_numpy()[places].T)
        advantages[places] = second - first
    return pairs.assign(advantage=advantages)


def units_of(task: Task, pairs: pd.DataFrame) -> pd.DataFrame:
    """Return the units of cases of a task, in which every case weighs the same.

    Parameters
    ----------
    task : Task
    pairs : DataFrame
        Numbers, indexed by (case, fold).

    Returns
    -------
    DataFrame
        One row per unit: the means of the columns, and its ``share`` of the mean over cases.
    """
    subjects = {case.name: case.subjects for case in task.cases}
    units = [
        unit
        for name, fold in pairs.index
        for case in [CaseLayout(name, {}, subjects=subjects.get(name, ()))]  # or one that is gone
        for unit in unit_names(case, [fold], independent=task.independent_folds)
    ]
    weights = unit_weights(units, pairs.index.get_level_values("case").to_list())
    shares: NDArray[np.float64] = np.asarray(weights.sum(axis=1)).ravel()
    means = (weights @ pairs.to_numpy()) / shares[:, None]
    return pd.DataFrame(means, columns=pairs.columns).assign(share=shares)
