"""Replicates as independent draws (docs/mathematics/inference.md, section 2, "Independent")."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.gp.prior.parameters import CHILD
from mocapbench.baselines.gp.reduction.reduction import PosteriorTerm, Reduction
from mocapbench.baselines.gp.reduction.replicates import Pattern, Replicates
from mocapbench.baselines.gp.solvers.block import Block, Target

__all__ = ["independent"]


def independent(replicates: Replicates) -> Reduction:
    """Reduce replicates that are independent draws of one process, f_r ~ GP(0, K_f).

    There is one block for each pattern of visible entries, with the pattern's members as its data
    vectors.
    """
    zeros = np.zeros(replicates.data.shape[1])
    # A replicate of which nothing is visible has its prior.
    prior = Target({CHILD: np.zeros(1)}, {CHILD: 1.0})
    terms = [(PosteriorTerm(0, 0, prior),)] * len(replicates.data)
    for index, pattern in enumerate(replicates.patterns):
        for column, r in enumerate(pattern.members):
            terms[r] = (PosteriorTerm(index, column, Target({CHILD: np.ones(1)}, {})),)
    return Reduction(
        blocks=tuple(_block(replicates, pattern) for pattern in replicates.patterns),
        replicates=tuple(terms),
        trend=(),
        constant=0.0,
        within_dof=zeros,
        within_scatter=zeros,
    )


def _block(replicates: Replicates, pattern: Pattern) -> Block:
    """Return the problem of the members of a pattern."""
    return Block(
        times=replicates.times,
        units={CHILD: np.ones((1, 1))},
        observed=pattern.observed[None],
        data=replicates.data[pattern.members][:, None],
        noise_scale=np.ones((1, *pattern.observed.shape)),
        multiplicity=pattern.size,
    ).trim()
