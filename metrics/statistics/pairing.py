"""What one unit of a test is: a fold, or a case where folds are no independent draws."""

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
        Columns ``first`` and ``second``, in the order of ``first``. What only one side has is
        left out: unpaired values would bring the difference between problems into that between
        entrants.
    """
    both = pd.concat({"first": first, "second": second}, axis=1, join="inner").astype(float)
    return both.replace([np.inf, -np.inf], np.nan).dropna()


def case_units(pairs: pd.DataFrame, case: str, *, independent: bool) -> pd.DataFrame:
    """Return the units of one case: its folds, or their mean where folds are not independent."""
    own = pairs[pairs.index.get_level_values(0) == case]
    return own if independent or own.empty else own.mean().to_frame().T


def pooled_units(pairs: pd.DataFrame, *, independent: bool) -> pd.DataFrame:
    """Return the units of a task: the means of its cases, or the units of its only case.

    Cases are the units of a comparison over cases, however many folds each has, as data sets are
    in J. Demšar (2006), Statistical comparisons of classifiers over multiple data sets, JMLR 7.
    """
    cases = pairs.index.get_level_values(0)
    if cases.nunique() == 1:
        return case_units(pairs, cases[0], independent=independent)
    return pairs.groupby(level=0, sort=False).mean()
