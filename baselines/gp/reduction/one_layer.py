"""Replicates in one layer: as noisy observations of one function, or as independent draws.

See docs/mathematics/inference.md, section 2.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.prior.parameters import CHILD, PARENT
from mocapbench.baselines.gp.reduction.reduction import Reduction
from mocapbench.baselines.gp.reduction.replicates import Replicates
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.basics.arrays import Index

__all__ = ["pool_replicates", "separate_replicates"]


def pool_replicates(replicates: Replicates) -> Reduction:
    """Reduce replicates that are noisy observations of one and the same function g.

    The n_dt values of an entry are replaced by their mean, with noise variance β_d / n_dt. Their
    scatter around the mean depends on the noise only.
    """
    # n_dt, the means and the squares of the deviations from them.
    counts = replicates.observed.sum(axis=0)
    observed = counts > 0
    safe = np.maximum(counts, 1)
    mean = replicates.data.sum(axis=0) / safe
    scatter = np.where(replicates.observed, replicates.data - mean, 0.0) ** 2
    block = Block(
        times=replicates.times,
        units={PARENT: np.ones((1, 1))},
        observed=observed[None],
        data=mean[None, None],
        noise_scale=(1.0 / safe)[None],
        multiplicity=1,
    )
    trend = (Target({PARENT: np.ones(1)}),)
    return Reduction(
        blocks=(block,),
        replicates=(trend,) * len(replicates.data),
        trend=trend,
        constant=-0.5 * float(np.log(safe).sum()),
        within_dof=(safe - 1.0).sum(axis=1),
        within_scatter=scatter.sum(axis=(0, 2)),
    )


def separate_replicates(replicates: Replicates) -> Reduction:
    """Reduce replicates that are independent draws of one process, f_r ~ GP(0, K_f).

    There is one block for each pattern of visible entries, with the pattern's members as its data
    vectors.
    """
    zeros = np.zeros(replicates.data.shape[1])
    # A replicate of which nothing is visible has its prior.
    prior = Target({CHILD: np.zeros(1)}, {CHILD: 1.0})
    terms = [(prior,)] * len(replicates.data)
    for block, (members, _) in enumerate(replicates.patterns):
        for column, r in enumerate(members):
            terms[r] = (Target({CHILD: np.ones(1)}, block=block, column=column),)
    return Reduction(
        blocks=tuple(_block(replicates, *pattern) for pattern in replicates.patterns),
        replicates=tuple(terms),
        trend=(),
        constant=0.0,
        within_dof=zeros,
        within_scatter=zeros,
    )


def _block(replicates: Replicates, members: Index, observed: NDArray[np.bool_]) -> Block:
    """Return the problem of the members of a pattern."""
    return Block(
        times=replicates.times,
        units={CHILD: np.ones((1, 1))},
        observed=observed[None],
        data=replicates.data[members][:, None],
        noise_scale=np.ones((1, *observed.shape)),
        multiplicity=len(members),
    ).trim()
