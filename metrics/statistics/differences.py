"""Tests and intervals of the mean of paired differences, and Holm's correction.

One difference tells nothing of chance: what cannot be computed is NaN. Differences that are all
equal leave no doubt: their interval is a point, and p is 0, or 1 where they are all zero.
"""

from __future__ import annotations

import math
from functools import cache
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import stats

__all__ = [
    "ALPHA",
    "holm",
    "least_signed_rank_p",
    "mean_interval",
    "signed_rank_test",
    "standard_error",
    "t_test",
    "validated",
]

ALPHA = 0.05
MOST_ENUMERATED = 12

Array = NDArray[np.float64]


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


def standard_error(differences: ArrayLike) -> float:
    """Return the standard error of the mean (ddof 1) of independent units; NaN for one."""
    values = validated(differences)
    if values.size == 1:
        return math.nan
    if np.ptp(values) == 0.0:  # rounding of the mean would leave a spread
        return 0.0
    return float(np.std(values, ddof=1)) / math.sqrt(values.size)


def mean_interval(differences: ArrayLike, confidence: float = 0.95) -> tuple[float, float]:
    """Return the interval of the mean by Student's t with n − 1 degrees of freedom."""
    values = validated(differences)
    half = stats.t.ppf(0.5 + 0.5 * confidence, values.size - 1) * standard_error(values)
    return float(values.mean() - half), float(values.mean() + half)


def t_test(differences: ArrayLike) -> float:
    """Return the two-sided p-value of the paired t-test of a mean difference of zero."""
    values = validated(differences)
    error = standard_error(values)
    if error == 0.0:
        return float(values[0] == 0.0)
    return float(2.0 * stats.t.sf(abs(values.mean()) / error, values.size - 1))


def signed_rank_test(differences: ArrayLike) -> float:
    """Return the two-sided p-value of Wilcoxon's signed-rank test.

    Zero differences are dropped. Up to twelve units all signs are enumerated, so that p is exact
    with ties too; the normal approximation would go below what so few units can give.
    """
    values = validated(differences)
    if values.size == 1:
        return math.nan
    if not values.any():
        return 1.0
    if values.size > MOST_ENUMERATED:
        return float(stats.wilcoxon(values).pvalue)
    ranked = values[values != 0.0]
    ranks = stats.rankdata(np.abs(ranked))
    extreme = np.abs(_every_sign(ranked.size) @ ranks) >= abs(np.sign(ranked) @ ranks)
    return float(extreme.mean())


@cache
def _every_sign(n: int) -> Array:
    """Return the 2ⁿ ways to give n ranks a sign, shape (2ⁿ, n)."""
    return np.array(list(product((-1.0, 1.0), repeat=n)))


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
