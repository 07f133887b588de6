r"""The multiple-output hierarchical Gaussian process (thesis §4).

Every recording is a child of one parent: :math:`g \sim \mathcal{GP}(0, K_g)`,
:math:`f_r \sim \mathcal{GP}(g, K_f)`, :math:`y_r = f_r + \varepsilon_r`, with a linear model of
coregionalisation in both layers (thesis eq. 16 and 17).
"""

from __future__ import annotations

from typing import ClassVar

from mocapbench.baselines.gp.parameters import CHILD, PARENT
from mocapbench.baselines.gp.reduction import Reduction, hierarchical
from mocapbench.baselines.gp.replicates import Replicates
from mocapbench.baselines.gp.trended import TrendedProcess

__all__ = ["MOHGP"]


class MOHGP(TrendedProcess):
    """Recordings vary around a common trend.

    `impute` gives the posterior of each child. `sample` follows the thesis: new children are
    drawn from K_f around the trend's posterior mean, or around a draw of the trend with
    ``sampled_trend="posterior"``. Parameters and attributes are those of
    `GaussianProcess`.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.datasets import ToyProcess
    >>> rng = np.random.default_rng(0)
    >>> process = ToyProcess.random(rng, n_outputs=2, noise=0.01)
    >>> children = process.draw(rng, np.linspace(0.0, 6.0, 20), 3)
    >>> model = MOHGP(kernel="rbf", max_iter=20).fit(children)
    >>> mean, variance = model.trend(np.linspace(0.0, 6.0, 5))
    >>> mean.shape, variance.shape
    ((5, 2), (5, 2))
    """

    layers: ClassVar[tuple[str, ...]] = (PARENT, CHILD)

    @staticmethod
    def reduce(replicates: Replicates) -> Reduction:
        """Return the likelihood of replicates in standard units as block problems."""
        return hierarchical(replicates)
