"""Pairs of values: of the same problems, solved by two entrants."""

from __future__ import annotations

import numpy as np
import pandas as pd

__all__ = ["pair"]


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
