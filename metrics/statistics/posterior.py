"""The Bayesian correlated t-test: the probability that one entrant is better than another."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy import stats

from mocapbench.metrics.statistics.differences import validated

__all__ = ["Posterior", "correlated_t_test"]


@dataclass(frozen=True)
class Posterior:
    """Probabilities that the first entrant is better, practically equivalent or worse; sum is 1."""

    better: float
    equivalent: float
    worse: float


def correlated_t_test(differences: ArrayLike, rope: float) -> Posterior:
    """Return the probabilities that the mean advantage is above, in or below the equivalent region.

    The posterior is Student's t with n − 1 degrees of freedom, location x̄ and squared scale
    (1/n + ρ/(1 − ρ)) s², with ρ = 1/n after Nadeau and Bengio: folds that share data are
    correlated, and the posterior of independent ones would be too narrow.

    Parameters
    ----------
    differences : array-like of shape (n,)
        Advantages of the first entrant, one a unit.
    rope : float
        Half the width of the region of practical equivalence, in the unit of the differences.

    Returns
    -------
    Posterior
        NaN for a single unit, whose variance is unknown. If all differences are equal, one of the
        three is 1.

    References
    ----------
    A. Benavoli, G. Corani, J. Demšar, M. Zaffalon (2017). Time for a change: a tutorial for
    comparing multiple classifiers through Bayesian analysis. JMLR 18(77), §3.1.
    C. Nadeau, Y. Bengio (2003). Inference for the generalization error. Machine Learning 52.
    """
    values = validated(differences)
    n, mean = values.size, float(values.mean())
    if n == 1:
        return Posterior(math.nan, math.nan, math.nan)
    if np.ptp(values) == 0.0:
        better, worse = float(values[0] > rope), float(values[0] < -rope)
    else:
        correlation = 1.0 / n
        inflation = 1.0 / n + correlation / (1.0 - correlation)
        scale = math.sqrt(inflation) * float(np.std(values, ddof=1))
        better = float(stats.t.sf(rope, n - 1, loc=mean, scale=scale))
        worse = float(stats.t.cdf(-rope, n - 1, loc=mean, scale=scale))
    return Posterior(better, max(0.0, 1.0 - better - worse), worse)
