"""The Bayesian correlated t-test: the probability that one entrant is better than another."""

from __future__ import annotations

import math

from numpy.typing import ArrayLike
from scipy import special

from mocapbench.metrics.statistics.differences import mean_of

__all__ = ["correlated_t_test"]


def correlated_t_test(
    differences: ArrayLike, rope: float, shares: ArrayLike | None = None
) -> tuple[float, float, float]:
    """Return the probabilities that the mean advantage is above, in and below the region.

    The posterior is Student's t with ν degrees of freedom, location x̄ and squared scale
    (1 + n ρ/(1 − ρ)) e², where e is the standard error of x̄. Here n = ν + 1 is what the units are
    worth (`mocapbench.metrics.statistics.means`), their number where shares are equal, and ρ = 1/n
    after Nadeau and Bengio: folds that share data are correlated, and the posterior of independent
    ones would be too narrow.

    Parameters
    ----------
    differences : array-like of shape (n,)
        Advantages of the first entrant, one a unit.
    rope : float
        Half the width of the region of practical equivalence, in the unit of the differences.
    shares : array-like of shape (n,) or None
        What each unit weighs, with the sum 1; by default all weigh the same.

    Returns
    -------
    (float, float, float)
        That the first entrant is better, practically equivalent and worse; their sum is 1. NaN for
        a single unit, whose variance is unknown. If all differences are equal, one of them is 1.

    References
    ----------
    A. Benavoli, G. Corani, J. Demšar, M. Zaffalon (2017). Time for a change: a tutorial for
    comparing multiple classifiers through Bayesian analysis. JMLR 18(77), §3.1.
    C. Nadeau, Y. Bengio (2003). Inference for the generalization error. Machine Learning 52.
    """
    found = mean_of(differences, shares)
    mean, error, freedom = float(found.mean), float(found.error), float(found.freedom)
    if math.isnan(error):
        return math.nan, math.nan, math.nan
    if error == 0.0:
        better, worse = float(mean > rope), float(mean < -rope)
    else:
        scale = math.sqrt(1.0 + (freedom + 1.0) / freedom) * error
        better = float(special.stdtr(freedom, (mean - rope) / scale))
        worse = float(special.stdtr(freedom, (-rope - mean) / scale))
    return better, max(0.0, 1.0 - better - worse), worse
