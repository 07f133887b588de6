"""Families of paired t-tests: Holm's correction, and intervals that say the same as the tests.

Holm's method orders the p-values of m tests, p₁ ≤ … ≤ pₘ, and rejects the i-th while
pᵢ ≤ α/(m − i + 1). Every test is thus decided at a level of its own: the i-th rejected one at
α/(m − i + 1), and all that remain after r rejections at α/(m − r), which the least of their
p-values exceeds. The interval of a mean is Student's at that level, so that it excludes 0 exactly
where the corrected p is at most α. The chance that any true difference of 0 is rejected is at most
α. The chance that all intervals cover at once is not 1 − α: they show the steps of the test.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from mocapbench.basics.arrays import Array
from mocapbench.metrics.statistics.differences import ALPHA, holm
from mocapbench.metrics.statistics.means import UnitMeans, unit_means

__all__ = ["holm_tests", "holm_tests_of_means"]


def holm_tests(differences: ArrayLike) -> pd.DataFrame:
    """Test each row of paired differences, all of one family.

    Parameters
    ----------
    differences : array-like of shape (m, n)
        One row per test, one column per unit; finite.
    """
    rows = np.asarray(differences, dtype=float)
    n = rows.shape[1]
    return holm_tests_of_means(unit_means(rows, np.full(n, 1.0 / n)))


def holm_tests_of_means(means: UnitMeans) -> pd.DataFrame:
    """Test the means of a family.

    Parameters
    ----------
    means : UnitMeans
        Of shape (m,). A NaN error is a test that cannot be made: it does not count in the family.

    Returns
    -------
    DataFrame of m rows
        The ``mean``; ``low`` and ``high``, the interval that includes 0 where the mean is not
        separable from 0; ``p``, two-sided, of Student's t-test after Holm's correction, and
        ``uncorrected_p``; whether the mean is ``separable`` from 0 by more than chance, never
        without a test. NaN where no test is possible.
    """
    p = means.p
    corrected = holm(p)
    half = means.half_widths(_levels(p, corrected))
    return pd.DataFrame(
        {
            "mean": means.mean,
            "low": means.mean - half,
            "high": means.mean + half,
            "p": corrected,
            "uncorrected_p": p,
            "separable": corrected <= ALPHA,
        }
    )


def _levels(p: Array, corrected: Array) -> Array:
    """Return the level at which Holm's method decides each test."""
    n_tests, rejected = np.count_nonzero(np.isfinite(p)), corrected <= ALPHA
    place = np.empty(p.size)
    place[np.argsort(p, kind="stable")] = np.arange(p.size)
    steps = np.where(rejected, place, np.count_nonzero(rejected))
    return np.asarray(ALPHA / np.maximum(n_tests - steps, 1.0))
