"""Wilcoxon's signed-rank test of paired differences."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import stats

from mocapbench.basics.arrays import Array
from mocapbench.metrics.statistics.differences import check_differences

__all__ = ["least_signed_rank_p", "signed_rank_test"]

_MOST_EXACT = 100
"""Units that differ, of which signed ranks are enumerated: normal theory is good for more."""


def signed_rank_test(differences: ArrayLike) -> float:
    """Return the two-sided p-value of Wilcoxon's signed-rank test.

    Zero differences are dropped. With up to a hundred others p is exact, ties included: the share
    of all assignments of signs to the ranks whose sum is as far from zero. Above that it is
    SciPy's normal approximation, which for few would fall below the least p that they can have.

    Parameters
    ----------
    differences : array-like of shape (n,)
        One per unit; units are independent.

    Returns
    -------
    float
        NaN for a single unit; 1 if all differences are zero.

    Raises
    ------
    ValueError
        If there is no difference, or one is not finite.
    """
    values = check_differences(differences)
    if values.size == 1:
        return math.nan
    if not values.any():
        return 1.0
    kept = values[values != 0.0]
    if kept.size > _MOST_EXACT:
        return float(stats.wilcoxon(kept, method="approx").pvalue)
    doubled = np.rint(2.0 * stats.rankdata(np.abs(kept))).astype(int)  # ranks of ties are halves
    sums = np.arange(-doubled.sum(), doubled.sum() + 1)
    extreme = np.abs(sums) >= abs(int(np.sign(kept) @ doubled))
    return float(_chances(doubled)[extreme].sum())


def _chances(ranks: NDArray[np.intp]) -> Array:
    """Return the chance of each sum of ranks, from the least to the largest, with random signs."""
    chances = np.zeros(2 * ranks.sum() + 1)
    chances[0] = 1.0
    for rank in ranks:  # it adds up to all ranks twice, or to none, from the least sum on
        chances = 0.5 * (chances + np.roll(chances, 2 * rank))
    return chances


def least_signed_rank_p(n: int) -> float:
    """Return the least p-value that ``n`` units can give in the two-sided signed-rank test."""
    return math.ldexp(1.0, 1 - n)
