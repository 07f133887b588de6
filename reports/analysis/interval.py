"""Student's 95 % intervals of means over units."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy import special

from mocapbench.reports.analysis.grid import Array

__all__ = ["half_widths"]

UPPER = 0.975


def half_widths(values: ArrayLike) -> Array:
    """Return half the 95 % interval of each mean over the last axis.

    Parameters
    ----------
    values : array-like of shape (..., n_units)
        NaN where there is no value.

    Returns
    -------
    ndarray of shape (...)
        NaN where there are fewer than two values.
    """
    units = np.asarray(values, dtype=float)
    present = np.isfinite(units)
    n = present.sum(axis=-1)
    freedom = np.maximum(n - 1, 1)
    means = np.where(present, units, 0.0).sum(axis=-1) / np.maximum(n, 1)
    squares = np.where(present, units - means[..., None], 0.0) ** 2
    errors = np.sqrt(squares.sum(axis=-1) / freedom / np.maximum(n, 1))
    return np.where(n > 1, special.stdtrit(freedom, UPPER) * errors, np.nan)
