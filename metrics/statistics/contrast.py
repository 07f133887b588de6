"""The contrast of two entrants over paired units: means, interval, tests and probabilities."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Array
from mocapbench.metrics.statistics.differences import mean_interval, mean_of, t_test
from mocapbench.metrics.statistics.means import too_few
from mocapbench.metrics.statistics.posterior import correlated_t_test
from mocapbench.metrics.statistics.signed_ranks import signed_rank_test

__all__ = ["ROPE", "Contrast", "contrast"]

ROPE = 0.02
"""Region of practical equivalence: two entrants within 2 % of their mean value are equivalent."""


@dataclass(frozen=True)
class Contrast:
    """The comparison of two entrants over paired units.

    Parameters
    ----------
    n : int
        Number of units that both have; if 0, all means are NaN. Where they are too few
        (`mocapbench.metrics.statistics.means`) there is neither an interval, nor a test, nor a
        probability.
    first, second : float
        Mean values over the units, by their shares.
    advantage, low, high : float
        By how much the first is better, with the 95 % interval; negative is worse.
    t_p, signed_rank_p : float
        Two-sided p-values of the paired t-test and of Wilcoxon's test, not corrected. Wilcoxon's
        counts every unit once, whatever its share.
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

    @property
    def tested(self) -> bool:
        """Whether there are enough units for a test."""
        return not math.isnan(self.t_p)


def contrast(units: pd.DataFrame, rope: float = ROPE) -> Contrast:
    """Return the contrast of two entrants.

    Parameters
    ----------
    units : DataFrame
        One row per unit: the values ``first`` and ``second``, the ``advantage`` of the first, all
        finite, and the unit's ``share`` of the means. Shares sum to 1.
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
    columns = ("first", "second", "advantage", "share")
    first, second, advantages, shares = (units[name].to_numpy(float) for name in columns)
    means = Contrast(
        n=len(units),
        first=float(shares @ first),
        second=float(shares @ second),
        advantage=float(shares @ advantages),
    )
    if too_few(mean_of(advantages, shares).freedom):
        return means
    scale = float(shares @ (np.abs(first) + np.abs(second))) / 2.0
    return _test_advantages(means, advantages, shares, rope * scale)


def _test_advantages(means: Contrast, advantages: Array, shares: Array, rope: float) -> Contrast:
    """Return ``means`` with the interval, p-values and probabilities of the advantages."""
    low, high = mean_interval(advantages, shares=shares)
    better, equivalent, worse = correlated_t_test(advantages, rope, shares)
    return replace(
        means,
        low=low,
        high=high,
        t_p=t_test(advantages, shares),
        signed_rank_p=signed_rank_test(advantages),
        better=better,
        equivalent=equivalent,
        worse=worse,
    )
