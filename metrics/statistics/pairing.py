"""Units of a test: folds, or whole cases where folds are not independent draws."""

from __future__ import annotations

import numpy as np
import pandas as pd

__all__ = ["case_units", "pair", "pooled_units"]


def pair(first: pd.Series[float], second: pd.Series[float]) -> pd.DataFrame:
    """Return the finite values at the addresses that both series have.

    Parameters
    ----------
    first, second : Series
        Values indexed by (case, fold), each address once.

    Returns
    -------
    DataFrame
        Columns ``first`` and ``second``, in the order of ``first``. Addresses that only one side
        has are left out: unpaired values would mix differences between problems with those between
        entrants.
    """
    both = pd.concat({"first": first, "second": second}, axis=1, join="inner").astype(float)
    return both.replace([np.inf, -np.inf], np.nan).dropna()


def case_units(pairs: pd.DataFrame, case: str, *, independent: bool) -> pd.DataFrame:
    """Return the units of one case: its folds, or their mean where folds are not independent."""
    folds = pairs[pairs.index.get_level_values(0) == case]
    return folds if independent or folds.empty else folds.mean().to_frame().T


def pooled_units(pairs: pd.DataFrame, *, independent: bool) -> pd.DataFrame:
    """Return the units of a task: the means of its cases, or the units of its only case.

    In a comparison over cases each case counts once, however many folds it has, like data sets in
    J. Demšar (2006), Statistical comparisons of classifiers over multiple data sets, JMLR 7.
    """
    cases = pairs.index.get_level_values(0)
    if cases.nunique() == 1:
        return case_units(pairs, cases[0], independent=independent)
    return pairs.groupby(level=0, sort=False).mean()
