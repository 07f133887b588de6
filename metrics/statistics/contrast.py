"""The contrast of two entrants over paired units: means, interval, tests and probabilities."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pandas as pd

from mocapbench.metrics.statistics.differences import mean_interval, signed_rank_test, t_test
from mocapbench.metrics.statistics.posterior import correlated_t_test

__all__ = ["ROPE", "Contrast", "contrast"]

ROPE = 0.02
"""Region of practical equivalence: two entrants within 2 % of their mean value are equivalent."""


@dataclass(frozen=True)
class Contrast:
    """The comparison of two entrants over paired units.

    Parameters
    ----------
    n : int
        Number of units that both have; if 0, all other fields are NaN.
    first, second : float
        Mean values over the units.
    advantage, low, high : float
        By how much the first is better, with the 95 % interval; negative is worse.
    t_p, signed_rank_p : float
        Two-sided p-values of the paired t-test and of Wilcoxon's test, not corrected.
    better, equivalent, worse : float
        Probabilities by the Bayesian correlated t-test.
    """

    n: int
    first: float = math.nan
    second: float = math.nan
    advantage: float = math.nan
    low: float = math.nan
    high: float = math.nan
    t_p: float = math.nan
    signed_rank_p: float = math.nan
    better: float = math.nan
    equivalent: float = math.nan
    worse: float = math.nan


def contrast(units: pd.DataFrame, loss: Callable[[float], float], rope: float = ROPE) -> Contrast:
    """Return the contrast of the two columns of ``units``.

    Parameters
    ----------
    units : DataFrame
        One row per unit, columns ``first`` and ``second``, finite: see `case_units` and
        `pooled_units`.
    loss : callable
        From a value of the metric to its loss, of which lower is better.
    rope : float
        Half the width of the region of practical equivalence, as a share of the mean absolute
        value of both columns.

    Raises
    ------
    ValueError
        If ``rope`` is negative.
    """
    if not rope >= 0.0:
        raise ValueError(f"expected a region of practical equivalence of 0 or more, got {rope}")
    if units.empty:
        return Contrast(0)
    advantages = (units["second"].map(loss) - units["first"].map(loss)).to_numpy(float)
    scale = float(np.abs(units[["first", "second"]].to_numpy(float)).mean())
    posterior = correlated_t_test(advantages, rope * scale)
    low, high = mean_interval(advantages)
    return Contrast(
        n=len(units),
        first=float(units["first"].mean()),
        second=float(units["second"].mean()),
        advantage=float(advantages.mean()),
        low=low,
        high=high,
        t_p=t_test(advantages),
        signed_rank_p=signed_rank_test(advantages),
        **vars(posterior),
    )
