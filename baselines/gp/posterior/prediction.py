"""Posterior means and variances of curves, as sums of independent terms.

See docs/mathematics/prediction.md, section 8.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.reduction.reduction import PosteriorTerm, Reduction
from mocapbench.baselines.gp.solvers.solver import Solver
from mocapbench.basics.arrays import Array

__all__ = ["infer"]


def infer(
    reduction: Reduction,
    solvers: Sequence[Solver],
    parameters: Parameters,
    curves: Sequence[tuple[PosteriorTerm, ...]],
    times: Sequence[Array],
) -> list[tuple[Array, Array]]:
    """Return the posterior means and variances of noise-free curves.

    Every block that is needed is conditioned once.

    Parameters
    ----------
    reduction : Reduction
        The likelihood as block problems.
    solvers : sequence of Solver
        One for each block.
    parameters : Parameters
        The parameters of the model.
    curves : sequence of tuple of PosteriorTerm
        The terms of each curve.
    times : sequence of ndarray of shape (M,)
        The times of each curve, in any order.

    Returns
    -------
    list of tuple of two ndarrays of shape (M, D)
        Posterior mean and variance of each curve.
    """
    posteriors = {
        index: solvers[index].condition(reduction.blocks[index], parameters)
        for index in sorted({term.block for terms in curves for term in terms})
    }
    inferred = []
    for terms, at in zip(curves, times, strict=True):
        mean, variance = np.zeros((2, len(at), len(parameters.log_noise)))
        for term in terms:
            means, term_variance = posteriors[term.block].predict(term.target, at)
            mean += means[term.column].T
            variance += term_variance.T
        inferred.append((mean, variance))
    return inferred
