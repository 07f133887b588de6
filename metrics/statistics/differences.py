"""The t-test and the interval of a mean of paired differences, and Holm's correction.

A single difference has no variance, so everything that needs one is NaN. Where all differences are
equal, their interval has no width, and p is 0, or 1 if they are all zero.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mocapbench.basics.arrays import Array
from mocapbench.metrics.statistics.means import UnitMeans, unit_means

__all__ = [
    "ALPHA",
    "check_differences",
    "holm",
    "mean_interval",
    "mean_of",
    "t_test",
]

ALPHA = 0.05


def check_differences(differences: ArrayLike) -> Array:
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


def mean_of(differences: ArrayLike, shares: ArrayLike | None = None) -> UnitMeans:
    """Return the mean of differences, one a unit, whose shares of it are equal unless given.

    Raises
    ------
    ValueError
        If there is no difference, or one is not finite.
    """
    values = check_differences(differences)
    return unit_means(values, np.full(values.size, 1.0 / values.size) if shares is None else shares)


def mean_interval(
    differences: ArrayLike, confidence: float = 0.95, shares: ArrayLike | None = None
) -> tuple[float, float]:
    """Return the confidence interval of the mean by Student's t.

    Parameters
    ----------
    differences : array-like of shape (n,)
        One per unit; units are independent.
    confidence : float
        Probability that the interval covers the mean, between 0 and 1.
    shares : array-like of shape (n,) or None
        What each unit weighs, with the sum 1; by default all weigh the same.

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
    found = mean_of(differences, shares)
    half = float(found.half_widths(1.0 - confidence))
    return float(found.mean) - half, float(found.mean) + half


def t_test(differences: ArrayLike, shares: ArrayLike | None = None) -> float:
    """Return the two-sided p-value of the paired t-test of a mean difference of zero.

    Parameters
    ----------
    differences : array-like of shape (n,)
        One per unit; units are independent.
    shares : array-like of shape (n,) or None
        What each unit weighs, with the sum 1; by default all weigh the same.

    Returns
    -------
    float
        NaN for a single unit. Where all differences are equal: 1 if they are zero, 0 otherwise.

    Raises
    ------
    ValueError
        If there is no difference, or one is not finite.
    """
    return float(mean_of(differences, shares).p)


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
