"""Replicates as noisy observations of one function (docs/mathematics/inference.md, section 2)."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.gp.prior.parameters import PARENT
from mocapbench.baselines.gp.reduction.reduction import PosteriorTerm, Reduction
from mocapbench.baselines.gp.reduction.replicates import Replicates
from mocapbench.baselines.gp.solvers.block import Block, Target

__all__ = ["pool_replicates"]


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
    trend = (PosteriorTerm(0, 0, Target({PARENT: np.ones(1)}, {})),)
    return Reduction(
        blocks=(block,),
        replicates=(trend,) * len(replicates.data),
        trend=trend,
        constant=-0.5 * float(np.log(safe).sum()),
        within_dof=(safe - 1.0).sum(axis=1),
        within_scatter=scatter.sum(axis=(0, 2)),
    )
