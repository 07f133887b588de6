"""Mean ranks of entrants over the units of a task.

Ranks are compared only where they can separate: over at least `FEWEST_UNITS` units, and where the
critical difference is less than k − 1, which is how far apart the first and the last of k can be.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from mocapbench.metrics.statistics import FEWEST_UNITS, RankComparison, compare_ranks, nemenyi
from mocapbench.reports.analysis.cells import Cells, cells
from mocapbench.reports.analysis.results import TaskResults

__all__ = ["Ranks", "ranks_over_units", "unit_losses"]

FEWEST_ENTRANTS = 3


@dataclass(frozen=True)
class Ranks:
    """Compared ranks, by label.

    Parameters
    ----------
    labels : tuple of str
        Entrants with a score in every case and fold, in table order.
    left_out : tuple of str
        Entrants that lack some.
    unit : str
        What the entrants are ranked over: ``"subject"``, ``"fold"`` or ``"case"``.
    comparison : RankComparison
    """

    labels: tuple[str, ...]
    left_out: tuple[str, ...]
    unit: str
    comparison: RankComparison


def ranks_over_units(results: TaskResults, metric: str) -> Ranks | None:
    """Return the ranks over the units of a task; None where they cannot separate any two."""
    scored = cells(results, metric)
    few = len(set(scored.units)) < FEWEST_UNITS
    return None if few else _ranks(unit_losses(scored), scored.unit)


def unit_losses(scored: Cells) -> pd.DataFrame:
    """Return mean losses, one row per unit and one column per label.

    A label that lacks a score in any cell is NaN throughout: what it lacks may be hard.
    """
    whole = scored.scored.all(axis=1)
    losses = np.where(np.expand_dims(whole, 1), scored.losses, np.nan)
    means = scored.by_unit(losses, np.ones(len(scored.cases), dtype=bool))
    return pd.DataFrame(means.T, columns=list(scored.labels))


def _ranks(losses: pd.DataFrame, unit: str) -> Ranks | None:
    whole = losses.dropna(axis=1)
    n, n_labels = whole.shape
    if n < FEWEST_UNITS or n_labels < FEWEST_ENTRANTS or nemenyi(n, n_labels) >= n_labels - 1:
        return None
    left_out = [label for label in losses.columns if label not in whole.columns]
    return Ranks(
        _names(whole.columns), _names(left_out), unit, compare_ranks(whole.to_numpy(float))
    )


def _names(labels: Sequence[str] | pd.Index[str]) -> tuple[str, ...]:
    return tuple(map(str, labels))
