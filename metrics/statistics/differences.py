"""Tests and intervals of the mean of paired differences, and Holm's correction.

A single difference has no variance, so everything that needs one is NaN. Where all differences are
equal, their interval has no width, and p is 0, or 1 if they are all zero.
"""

from __future__ import annotations

import math
import warnings
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import stats

__all__ = [
    "ALPHA",
    "FEWEST_UNITS",
    "holm",
    "least_signed_rank_p",
    "mean_interval",
    "signed_rank_test",
    "t_test",
    "validated",
]

ALPHA = 0.05

FEWEST_UNITS = 5
"""With fewer independent units no difference is tested: not to find one would say nothing."""

_MOST_EXACT = 100
"""Units that differ, of which signed ranks are enumerated: normal theory is good for more."""

Array = NDArray[np.float64]

# SciPy warns of lost precision where differences are equal except for rounding errors.
_without_warnings = partial(warnings.catch_warnings, action="ignore", category=RuntimeWarning)


def validated(differences: ArrayLike) -> Array:
    """Return ``differences`` as an array of shape (n,).

    Raises
    ------
    ValueError
        If there is none, or one is not finite.
    """
    values = np.asarray(differences, dtype=float)
    if values.ndim != 1 or not values.size or not np.isfinite(values).all():
        raise ValueError(
            f"expected one or more finite differences, one a unit, got {values!r}; "
            "pair the units that both entrants have first"
        )
    return values


def mean_interval(differences: ArrayLike, confidence: float = 0.95) -> tuple[float, float]:
    """Return the confidence interval of the mean by Student's t with n − 1 degrees of freedom.

    Parameters
    ----------
    differences : array-like of shape (n,)
        One per unit; units are independent.
    confidence : float
        Probability that the interval covers the mean, between 0 and 1.

    Returns
    -------
    low, high : float
        In the unit of the differences. NaN for a single unit; both the mean where all differences
        are equal.

    Raises
    ------
    ValueError
        If there is no difference, or one is not finite.
    """
    values = validated(differences)
    if values.size == 1:
        return math.nan, math.nan
    if _all_equal(values):
        return float(values.mean()), float(values.mean())
    with _without_warnings():
        low, high = stats.ttest_1samp(values, 0.0).confidence_interval(confidence)
    return float(low), float(high)


def t_test(differences: ArrayLike) -> float:
    """Return the two-sided p-value of the paired t-test of a mean difference of zero.

    Parameters
    ----------
    differences : array-like of shape (n,)
        One per unit; units are independent.

    Returns
    -------
    float
        NaN for a single unit. Where all differences are equal: 1 if they are zero, 0 otherwise.

    Raises
    ------
    ValueError
        If there is no difference, or one is not finite.
    """
    values = validated(differences)
    if values.size == 1:
        return math.nan
    if _all_equal(values):
        return float(values[0] == 0.0)
    with _without_warnings():
        return float(stats.ttest_1samp(values, 0.0).pvalue)


def _all_equal(values: Array) -> bool:
    """Return whether no difference differs; rounding of the mean could hide it in the variance."""
    return bool(np.ptp(values) == 0.0)


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
    values = validated(differences)
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


def holm(p_values: ArrayLike) -> Array:
    """Return Holm's step-down adjusted p-values of a family of tests.

    A NaN is a test that could not be made: it stays NaN and does not count in the family.

    References
    ----------
    S. Holm (1979). A simple sequentially rejective multiple test procedure. Scandinavian Journal
    of Statistics 6:65–70.
    """
    p = np.asarray(p_values, dtype=float)
    adjusted = np.full(p.shape, np.nan)
    order = np.argsort(p)[: np.count_nonzero(np.isfinite(p))]
    stepped = p[order] * np.arange(order.size, 0, -1)
    adjusted[order] = np.minimum(np.maximum.accumulate(stepped), 1.0)
    return adjusted
