"""Posterior curves as sums of independent shares."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.reduction.reduction import Reduction, Share
from mocapbench.baselines.gp.solvers.solver import Solver

__all__ = ["infer"]

Array = NDArray[np.float64]


def infer(
    reduction: Reduction,
    solvers: Sequence[Solver],
    parameters: Parameters,
    curves: Sequence[tuple[Share, ...]],
    times: Sequence[Array],
) -> list[tuple[Array, Array]]:
    """Infer noise-free curves, given by their shares, each at times of its own.

    There is one solver for each block of the reduction.

    Returns
    -------
    list of tuple of two ndarrays of shape (M, D)
        Posterior mean and variance of each curve. Every block that is needed is conditioned once.
    """
    posteriors = {
        index: solvers[index].condition(reduction.blocks[index], parameters)
        for index in sorted({share.block for shares in curves for share in shares})
    }
    inferred = []
    for shares, at in zip(curves, times, strict=True):
        mean, variance = np.zeros((2, len(at), len(parameters.log_noise)))
        for share in shares:
            means, of_share = posteriors[share.block].predict(share.target, at)
            mean += means[share.column].T
            variance += of_share.T
        inferred.append((mean, variance))
    return inferred
