"""Families of paired t-tests: Holm's correction, and intervals that say the same as the tests.

Holm's method orders the p-values of m tests, p₁ ≤ … ≤ pₘ, and rejects the i-th while
pᵢ ≤ α/(m − i + 1). Every test is thus decided at a level of its own: the i-th rejected one at
α/(m − i + 1), and all that remain after r rejections at α/(m − r), which the least of their
p-values exceeds. The interval of a mean is Student's at that level, so that it excludes 0 exactly
where the corrected p is at most α. The chance that any true difference of 0 is rejected is at most
α. The chance that all intervals cover at once is not 1 − α: they show the steps of the test.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy import special

from mocapbench.metrics.statistics.differences import ALPHA, Array, holm

__all__ = ["HolmTests", "holm_tests", "holm_tests_of_means", "means_and_errors"]


@dataclass(frozen=True, eq=False)
class HolmTests:
    """Means of a family with their intervals and corrected p-values, NaN where none is possible.

    Parameters
    ----------
    mean : ndarray of shape (m,)
    low, high : ndarray of shape (m,)
        The interval that includes 0 where the mean is not separable from 0.
    p : ndarray of shape (m,)
        Two-sided, of Student's t-test, after Holm's correction.
    uncorrected_p : ndarray of shape (m,)
    """

    mean: Array
    low: Array
    high: Array
    p: Array
    uncorrected_p: Array

    @property
    def separable(self) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        """Whether each mean differs from 0 by more than chance; never without a test."""
        return np.asarray(self.p <= ALPHA)


def holm_tests(differences: ArrayLike) -> HolmTests:
    """Test each row of paired differences, all of one family.

    Parameters
    ----------
    differences : array-like of shape (m, n)
        One row per test, one column per unit; finite.
    """
    rows = np.asarray(differences, dtype=float)
    n = rows.shape[1]
    means, errors = means_and_errors(rows, np.full(n, 1.0 / n))
    return holm_tests_of_means(means, errors, np.full(len(rows), n))


def means_and_errors(values: ArrayLike, shares: ArrayLike) -> tuple[Array, Array]:
    """Return weighted means over units and their standard errors, √(n/(n − 1) Σ s² (x − x̄)²).

    This is the error of a mean over cells that come in independent clusters; with equal shares it
    is that of the mean of the values.

    Parameters
    ----------
    values : array-like of shape (m, n)
        One row per mean, one column per unit.
    shares : array-like of shape (n,)
        Their sum is 1.

    Returns
    -------
    means, errors : ndarray of shape (m,)
        Exact where all values of a row are equal. The error of a single unit is NaN.
    """
    rows, weights = np.asarray(values, dtype=float), np.asarray(shares, dtype=float)
    n = rows.shape[1]
    # Rounding of the mean could hide in the variance that all values are equal.
    equal = np.ptp(rows, axis=1) == 0.0
    means = np.where(equal, rows[:, 0], rows @ weights)
    squares = (weights * (rows - means[:, None])) ** 2
    errors = np.sqrt(n / max(n - 1, 1) * squares.sum(axis=1))
    return means, errors if n > 1 else np.full(len(rows), np.nan)


def holm_tests_of_means(means: ArrayLike, errors: ArrayLike, n: ArrayLike) -> HolmTests:
    """Test the means of a family.

    Parameters
    ----------
    means, errors : array-like of shape (m,)
        Means and their standard errors. A NaN error is a test that cannot be made: it does not
        count in the family. With an error of 0, p is 0, or 1 where the mean is 0.
    n : array-like of shape (m,)
        Over how many units each mean is.
    """
    mean, error = np.asarray(means, dtype=float), np.asarray(errors, dtype=float)
    freedom = np.maximum(np.asarray(n, dtype=float) - 1.0, 1.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        p = 2.0 * special.stdtr(freedom, -np.abs(mean) / error)
    exact = error == 0.0
    p = np.where(exact, (mean == 0.0).astype(float), p)
    corrected = holm(p)
    half = error * special.stdtrit(freedom, 1.0 - _levels(p, corrected) / 2.0)
    half = np.where(exact, 0.0, half)
    return HolmTests(mean, mean - half, mean + half, corrected, p)


def _levels(p: Array, corrected: Array) -> Array:
    """Return the level at which Holm's method decides each test."""
    n_tests, rejected = np.count_nonzero(np.isfinite(p)), corrected <= ALPHA
    place = np.empty(p.size)
    place[np.argsort(p, kind="stable")] = np.arange(p.size)
    steps = np.where(rejected, place, np.count_nonzero(rejected))
    return np.asarray(ALPHA / np.maximum(n_tests - steps, 1.0))
