"""The power of the paired t-test: which difference so many units show, and how many one needs.

A test of n units at the level α calls a mean difference D other than 0 with the probability

    P(|T| > t),    t the two-sided critical value of Student's t with ν = n − 1,

where T has the noncentral t distribution with ν degrees of freedom and the noncentrality √n D/σ,
and σ is the standard deviation of the differences over units. Units of unequal shares count for
the ν + 1 units that they are worth (`mocapbench.metrics.statistics.means`), and n need be no whole
number.

References
----------
J. Cohen (1988). Statistical power analysis for the behavioral sciences, 2nd edition. Chapter 2.
"""

from __future__ import annotations

import math

import numpy as np
from scipy import optimize, special

from mocapbench.metrics.statistics.differences import ALPHA
from mocapbench.metrics.statistics.means import FEWEST_UNITS

__all__ = [
    "MOST_UNITS",
    "POWER",
    "detectable_difference",
    "deviation_interval",
    "power_of_t_test",
    "units_needed",
]

POWER = 0.8
"""With which probability a difference should be found, unless another is asked for."""

MOST_UNITS = 1_000_000
"""More units than anybody will record."""


def power_of_t_test(n: float, difference: float, deviation: float, alpha: float = ALPHA) -> float:
    """Return the probability that the two-sided t-test finds a difference.

    Parameters
    ----------
    n : float
        Of units, 2 or more.
    difference, deviation : float
        The true mean difference, and its standard deviation over units, above 0.
    alpha : float
        The level of the test.

    Raises
    ------
    ValueError
        If there are fewer than two units, no deviation, or a level outside 0 to 1.
    """
    _require_test(n, deviation, alpha)
    return _power(n, math.sqrt(n) * abs(difference) / deviation, alpha)


def detectable_difference(
    n: float, deviation: float, alpha: float = ALPHA, power: float = POWER
) -> float:
    """Return the difference that the test of ``n`` units finds with the probability ``power``.

    Raises
    ------
    ValueError
        As `power_of_t_test`, or if ``power`` is not between ``alpha`` and 1.
    """
    _require_test(n, deviation, alpha)
    _require_power(power, alpha)
    most = 1.0
    while _power(n, most, alpha) < power:
        most *= 2.0
    found = optimize.brentq(lambda away: _power(n, away, alpha) - power, 0.0, most)
    return float(found) * deviation / math.sqrt(n)


def units_needed(
    difference: float, deviation: float, alpha: float = ALPHA, power: float = POWER
) -> float:
    """Return the least number of units whose test finds a difference with ``power``.

    Returns
    -------
    float
        A whole number from `FEWEST_UNITS`, as fewer are not tested; infinite above `MOST_UNITS`,
        as for a difference of 0.

    Raises
    ------
    ValueError
        As `detectable_difference`.
    """
    _require_power(power, alpha)
    few, many = FEWEST_UNITS - 1, FEWEST_UNITS
    while power_of_t_test(many, difference, deviation, alpha) < power:
        if many >= MOST_UNITS:
            return math.inf
        few, many = many, min(2 * many, MOST_UNITS)
    while many - few > 1:
        middle = (few + many) // 2
        enough = power_of_t_test(middle, difference, deviation, alpha) >= power
        few, many = (few, middle) if enough else (middle, many)
    return float(many)


def deviation_interval(
    deviation: float, freedom: float, confidence: float = 0.95
) -> tuple[float, float]:
    """Return the confidence interval of a standard deviation, by the χ² distribution.

    Parameters
    ----------
    deviation : float
    freedom : float
        Degrees of freedom that it was estimated with, above 0.
    confidence : float
        Probability that the interval covers, between 0 and 1.
    """
    tails = np.array([1.0 - confidence, 1.0 + confidence]) / 2.0
    low, high = deviation * np.sqrt(freedom / special.chdtri(freedom, tails))
    return float(low), float(high)


def _power(n: float, away: float, alpha: float) -> float:
    """Return the power at the noncentrality ``away``, 0 or more."""
    freedom = n - 1.0
    critical = special.stdtrit(freedom, 1.0 - alpha / 2.0)
    # SciPy has NaN in place of some probabilities below 1e-14.
    below, beyond = np.nan_to_num(special.nctdtr(freedom, away, [critical, -critical]))
    return float(1.0 - below + beyond)


def _require_test(n: float, deviation: float, alpha: float) -> None:
    if not n >= 2:
        raise ValueError(f"expected two or more units, got {n}")
    if not 0.0 < deviation < math.inf:
        raise ValueError(f"expected a standard deviation above 0, got {deviation}")
    if not 0.0 < alpha < 1.0:
        raise ValueError(f"expected a level between 0 and 1, got {alpha}")


def _require_power(power: float, alpha: float) -> None:
    if not alpha < power < 1.0:
        raise ValueError(f"expected a power between the level {alpha} and 1, got {power}")
