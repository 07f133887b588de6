r"""One multiple-output Gaussian process of which every recording is a draw of its own.

:math:`f_r \sim \mathcal{GP}(0, K_f)` independently, :math:`y_r = f_r + \varepsilon_r`: recordings
share their statistics but not their shape. It is to the MOHGP what the thesis lacks, a baseline
with the same covariances and no hierarchy.
"""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.gp.prior.parameters import CHILD
from mocapbench.baselines.gp.reduction.independent import independent
from mocapbench.baselines.gp.reduction.reduction import Reduction
from mocapbench.baselines.gp.reduction.replicates import Replicates
from mocapbench.baselines.gp.reduction.tree import Tree

__all__ = ["LMCIndependent"]


class LMCIndependent(GaussianProcess):
    """Recordings are independent draws of one process.

    `impute` conditions each recording on its own visible entries. `sample` draws from the prior.
    Parameters and attributes are those of `GaussianProcess`.
    """

    def grow(self, names: Sequence[str]) -> Tree:
        """Return a draw for every recording."""
        return {CHILD: [(name,) for name in names]}

    def reduce(self, replicates: Replicates) -> Reduction:
        """Return the likelihood of replicates in standard units as block problems."""
        return independent(replicates)
