"""Means over independent units, which may weigh unequally, and Student's t of them.

The mean of n units is x̄ = Σ s x, with shares s whose sum is 1. Its error is cluster-robust (CR2),

    e² = Σ a (x − x̄)²,    a = s²/(1 − s),

without bias where the variance of a unit is proportional to 1/s, as that of the mean of so many
independent values is. Student's t has the degrees of freedom that Satterthwaite's rule gives e²
under the same variances,

    ν = 1/(Σ s² + (Σ a)² − Σ a²).

Where all shares are equal, e² is the squared error of a plain mean and ν = n − 1. Units are thus
*worth* ν + 1 units of equal shares, and docs/mathematics/error-rates.md has how well the level of
the test is kept.

References
----------
R. M. Bell, D. F. McCaffrey (2002). Bias reduction in standard errors for linear regression with
multi-stage samples. Survey Methodology 28:169–181.
G. W. Imbens, M. Kolesár (2016). Robust standard errors in small samples: some practical advice.
Review of Economics and Statistics 98:701–712.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from mocapbench.basics.arrays import Array

__all__ = ["FEWEST_UNITS", "UnitMeans", "too_few", "unit_means"]

FEWEST_UNITS = 5
"""With fewer independent units no difference is tested: not to find one would say nothing."""

_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class UnitMeans:
    """Means over units, each with what Student's t needs.

    Parameters
    ----------
    mean : ndarray of shape (...)
    error : ndarray of shape (...)
        Standard errors; 0 where all values are equal, NaN where there is no test.
    freedom : ndarray of shape (...)
        Degrees of freedom; NaN for fewer than two units.
    """

    mean: Array
    error: Array
    freedom: Array

    @property
    def p(self) -> Array:
        """Two-sided p-values of a mean of 0; with an error of 0 it is 0, or 1 if the mean is 0."""
        with np.errstate(divide="ignore", invalid="ignore"):
            p = 2.0 * special.stdtr(self.freedom, -np.abs(self.mean) / self.error)
        return np.where(self.error == 0.0, (self.mean == 0.0).astype(float), p)

    def half_widths(self, level: ArrayLike) -> Array:
        """Return half the intervals that miss the mean with the probability ``level``."""
        half = self.error * special.stdtrit(self.freedom, 1.0 - np.asarray(level) / 2.0)
        return np.where(self.error == 0.0, 0.0, half)

    def drop_errors_of_few_units(self) -> UnitMeans:
        """Return the means, without the errors of those over too few units."""
        return replace(self, error=np.where(too_few(self.freedom), np.nan, self.error))


def too_few(freedom: ArrayLike) -> NDArray[np.bool_]:
    """Return whether units are too few to test: worth no more than one below `FEWEST_UNITS`.

    Parameters
    ----------
    freedom : array-like of shape (...)
        Degrees of freedom, one less than what the units are worth. NaN is too few.
    """
    worth = np.asarray(freedom, dtype=float) + 1.0
    return np.asarray(~(worth > FEWEST_UNITS - 1 + _ROUNDING))


def unit_means(values: ArrayLike, shares: ArrayLike) -> UnitMeans:
    """Return means over the units of the last axis.

    Parameters
    ----------
    values : array-like of shape (..., n)
        Finite where the share is above 0.
    shares : array-like of shape (n,) or (..., n)
        With the sum 1; a unit of no share is left out.

    Returns
    -------
    UnitMeans
        Exact where all values are equal.
    """
    shares = np.asarray(shares, dtype=float)
    present = shares > 0.0
    units = np.where(present, values, 0.0)
    # Rounding of the mean could hide that all values are equal.
    least = np.where(present, units, np.inf).min(axis=-1, initial=np.inf)
    most = np.where(present, units, -np.inf).max(axis=-1, initial=-np.inf)
    mean = np.where(least == most, least, (shares * units).sum(axis=-1))
    with np.errstate(divide="ignore", invalid="ignore"):
        weights = shares**2 / (1.0 - shares)
        error = np.sqrt((weights * (units - mean[..., None]) ** 2).sum(axis=-1))
        freedom = _freedom(shares, weights)
    several = present.sum(axis=-1) > 1
    error, freedom = (np.where(several, of_mean, np.nan) for of_mean in (error, freedom))
    return UnitMeans(mean, error, np.broadcast_to(freedom, mean.shape))


def _freedom(shares: Array, weights: Array) -> Array:
    """Return Satterthwaite's degrees of freedom ν."""
    of_weights = weights.sum(axis=-1) ** 2 - (weights**2).sum(axis=-1)
    return np.asarray(1.0 / ((shares**2).sum(axis=-1) + of_weights))
