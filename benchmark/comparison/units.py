"""The units of a comparison, which are those of the report: people, where recordings are of people.

`mocapbench.reports.analysis.units` states the rule.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench.benchmark.results.bundle import case_layout
from mocapbench.benchmark.tasks.base import Task
from mocapbench.reports import CaseLayout
from mocapbench.reports.analysis.units import unit_names, unit_weights

__all__ = ["case_units", "pooled_units"]


def case_units(task: Task, pairs: pd.DataFrame, case: str) -> pd.DataFrame:
    """Return the units of one case of a task; see `pooled_units`."""
    return pooled_units(task, pairs[pairs.index.get_level_values("case") == case])


def pooled_units(task: Task, pairs: pd.DataFrame) -> pd.DataFrame:
    """Return the units of cases of a task, in which every case weighs the same.

    Parameters
    ----------
    task : Task
    pairs : DataFrame
        Columns ``first`` and ``second``, indexed by (case, fold).

    Returns
    -------
    DataFrame
        One row per unit: ``first``, ``second`` and its ``share`` of the mean. Shares sum to 1.
    """
    known = {case.name: case_layout(task, case) for case in task.cases}
    units = [
        unit
        for name, fold in pairs.index
        for case in [known.get(name, CaseLayout(name, {}))]  # of runs with cases that are gone
        for unit in unit_names(case, [fold], independent=task.independent_folds)
    ]
    weights = unit_weights(units, pairs.index.get_level_values("case").to_list())
    shares: NDArray[np.float64] = np.asarray(weights.sum(axis=1)).ravel()
    means = (weights @ pairs.to_numpy()) / shares[:, None]
    return pd.DataFrame(means, columns=pairs.columns).assign(share=shares)
