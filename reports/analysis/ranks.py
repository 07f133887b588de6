"""Mean ranks of entrants over the units of a task.

Ranks are compared only where they can separate: over at least `FEWEST_UNITS` units, and where the
critical difference is less than k − 1, which is how far apart the first and the last of k can be.
"""

from __future__ import annotations

import numpy as np
import pandas as pd

from mocapbench.metrics.statistics import FEWEST_UNITS, nemenyi
from mocapbench.reports.analysis.cells import cells
from mocapbench.reports.analysis.results import TaskResults

__all__ = ["ranks_over_units"]

FEWEST_ENTRANTS = 3


def ranks_over_units(results: TaskResults, metric: str) -> pd.DataFrame | None:
    """Return what labels are ranked by: mean losses, a row for each unit and a column a label.

    Returns
    -------
    DataFrame or None
        A label that lacks a score in any case and fold is NaN throughout, and is not ranked: what
        it lacks may be hard. The index is named by what a unit is: ``"subject"``, ``"fold"`` or
        ``"case"``. None where ranks cannot separate any two labels.
    """
    scored = cells(results, metric)
    if len(set(scored.units)) < FEWEST_UNITS:
        return None
    whole = np.expand_dims(scored.scored.all(axis=1), 1)
    losses = np.where(whole, scored.losses, np.nan)
    means = scored.by_unit(losses, np.ones(len(scored.cases), dtype=bool))
    n, n_labels = means.shape[1], int(whole.sum())
    if n < FEWEST_UNITS or n_labels < FEWEST_ENTRANTS or nemenyi(n, n_labels) >= n_labels - 1:
        return None
    return pd.DataFrame(means.T, columns=scored.labels).rename_axis(index=scored.unit)
