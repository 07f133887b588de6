r"""MOA, the thesis's reference model: one multiple-output Gaussian process.

All recordings are noisy observations of the *same* function, :math:`g \sim \mathcal{GP}(0, K_g)`,
:math:`y_r = g + \varepsilon_r`. What tells one recording from another is taken for noise, which is
why it interpolates so poorly (thesis §5.1).
"""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.baselines.gp.prior.parameters import PARENT
from mocapbench.baselines.gp.reduction.pooled import pooled
from mocapbench.baselines.gp.reduction.reduction import Reduction
from mocapbench.baselines.gp.reduction.replicates import Replicates
from mocapbench.baselines.gp.reduction.tree import Tree
from mocapbench.baselines.gp.trended import TrendedProcess

__all__ = ["MOA"]


class MOA(TrendedProcess):
    """Recordings are noisy observations of one function.

    `impute` and `trend` give the posterior of that function. `sample` takes its posterior mean as
    the trend and draws with the prior covariance around it. Parameters and attributes are those
    of `GaussianProcess`.
    """

    def grow(self, names: Sequence[str]) -> Tree:
        """Return the one draw that all recordings take part in."""
        return {PARENT: [()] * len(names)}

    def reduce(self, replicates: Replicates) -> Reduction:
        """Return the likelihood of replicates in standard units as block problems."""
        return pooled(replicates)
