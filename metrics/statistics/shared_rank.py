"""Entrants that share the first rank: the best mean and those not significantly worse."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from mocapbench.metrics.statistics.differences import ALPHA, holm, t_test

__all__ = ["SharedRank", "shared_rank"]


@dataclass(frozen=True)
class SharedRank:
    """The first rank of one row of a table.

    Parameters
    ----------
    labels : tuple of str
        Entrants that share it, the best mean first.
    n : int
        The most units of any test; below 2 no test is possible, and only equal means share.
    """

    labels: tuple[str, ...]
    n: int

    @property
    def tested(self) -> bool:
        """Whether there were enough units for a test."""
        return self.n > 1


def shared_rank(losses: pd.DataFrame, order: tuple[str, ...]) -> SharedRank:
    """Return the best entrant and those not significantly worse by paired t-tests.

    P-values are corrected by Holm's method. Wilcoxon's test cannot separate any two entrants in
    five units: its p is at least 0.0625. An entrant with fewer than two units in common with the
    best is not tested and does not share, unless all its common units are equal.

    Parameters
    ----------
    losses : DataFrame
        One row per unit, one column per label, NaN where a label has no value.
    order : tuple of str
        The labels by mean, best first.
    """
    best, *others = order
    tests = {label: (losses[label] - losses[best]).dropna().to_numpy(float) for label in others}
    p_values = holm([t_test(d) if d.size else np.nan for d in tests.values()])
    equal = [label for label, d in tests.items() if d.size and not d.any()]
    inseparable = [
        label
        for (label, d), p in zip(tests.items(), p_values, strict=True)
        # A loss that is not linear in the value can put another's mean loss below the best's.
        if p > ALPHA or (d.size > 1 and d.mean() < 0.0)
    ]
    sharing = {best, *equal, *inseparable}
    n = max((d.size for d in tests.values()), default=len(losses[best].dropna()))
    return SharedRank(tuple(label for label in order if label in sharing), n)
