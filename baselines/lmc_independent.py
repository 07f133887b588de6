r"""One multiple-output Gaussian process of which every recording is an independent draw.

:math:`f_r \sim \mathcal{GP}(0, K_f)` independently, :math:`y_r = f_r + \varepsilon_r`: recordings
share their covariance but no function. It has the same covariances as the MOHGP and no hierarchy,
a baseline that is missing from the thesis.

J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017, is cited as the thesis.
"""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.gp.parameter_docs import document_like
from mocapbench.baselines.gp.prior.parameters import CHILD
from mocapbench.baselines.gp.reduction.reduction import Reduction, Replicates, separate_replicates
from mocapbench.baselines.gp.reduction.tree import Tree

__all__ = ["LMCIndependent"]


@document_like(GaussianProcess)
class LMCIndependent(GaussianProcess):
    r"""A Gaussian process over all channels, of which recordings are independent draws.

    `impute` conditions each recording on its own visible entries. `sample` draws from the prior.

    Notes
    -----
    Recording r is a draw of its own, in which kernels :math:`k_q` of unit variance are shared by
    the channels:

    .. math::

        f_r \sim \mathcal{GP}\Bigl(0, \sum_q B_q \otimes k_q\Bigr), \quad
        B_q = W_q W_q^\top + \operatorname{diag}(\kappa_q)

    .. math::

        y_{rd}(t) = f_{rd}(t) + \varepsilon, \qquad \varepsilon \sim N(0, \beta_d)

    ``docs/mathematics/inference.md`` has the inference.

    References
    ----------
    M. A. Álvarez, L. Rosasco and N. D. Lawrence (2012), Kernels for Vector-Valued Functions: a
    Review, Foundations and Trends in Machine Learning 4(3): linear models of coregionalisation.

    J. D. Gil López (2017), Hierarchical Multiple Output Gaussian Processes for Human Motion Data,
    MSc thesis, Universidad Tecnológica de Pereira, eq. (13):
    the covariance.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import LMCIndependent
    >>> from mocapbench.datasets import ToyProcess
    >>> rng = np.random.default_rng(0)
    >>> process = ToyProcess.random(rng, n_outputs=2, noise=0.01)
    >>> times = np.linspace(0.0, 6.0, 20)
    >>> children = process.draw(rng, times, 3)
    >>> hidden = np.zeros((20, 2), dtype=bool)
    >>> hidden[8:12] = True
    >>> incomplete = children[0].hide(hidden)
    >>> model = LMCIndependent(kernel="rbf", max_iter=20).fit([incomplete, *children[1:]])
    >>> (prediction,) = model.impute([incomplete])
    >>> prediction.mean.shape, bool((prediction.variance[hidden] > 0).all())
    ((20, 2), True)
    """

    def grow(self, names: Sequence[str]) -> Tree:
        """Return one draw for every recording."""
        return {CHILD: [(name,) for name in names]}

    def reduce(self, replicates: Replicates) -> Reduction:
        """Return the likelihood of replicates in standard units as block problems."""
        return separate_replicates(replicates)
