r"""MOA, the reference model of the thesis: one multiple-output Gaussian process.

All recordings are noisy observations of the *same* function, :math:`g \sim \mathcal{GP}(0, K_g)`,
:math:`y_r = g + \varepsilon_r`. Differences between recordings count as noise, which explains its
large interpolation errors (thesis §5.1).

J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017, is cited as the thesis.
"""

from __future__ import annotations

from collections.abc import Sequence

from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.gp.parameter_docs import document_like
from mocapbench.baselines.gp.prior.parameters import PARENT
from mocapbench.baselines.gp.reduction.reduction import Reduction, Replicates, pool_replicates
from mocapbench.baselines.gp.reduction.tree import Tree
from mocapbench.baselines.protocols import Trended
from mocapbench.datasets import FrameByChannel, Frames

__all__ = ["MOA"]


@document_like(GaussianProcess)
class MOA(GaussianProcess, Trended):
    r"""A Gaussian process over all channels; recordings are noisy copies of one function.

    `trend` and `impute` give the posterior of that function. `sample` takes its posterior mean as
    the trend and draws with the prior covariance around it, as the thesis does (§5.2): samples
    differ by as much as the function varies, where recordings, by the model that is fitted, differ
    by noise alone.

    Notes
    -----
    All recordings r are of one function f:

    .. math::

        f \sim \mathcal{GP}\Bigl(0, \sum_q B_q \otimes k_q\Bigr), \quad
        B_q = W_q W_q^\top + \operatorname{diag}(\kappa_q)

    .. math::

        y_{rd}(t) = f_d(t) + \varepsilon, \qquad \varepsilon \sim N(0, \beta_d)

    ``docs/mathematics/inference.md`` has the inference.

    References
    ----------
    J. D. Gil López (2017), Hierarchical Multiple Output Gaussian Processes for Human Motion Data,
    MSc thesis, Universidad Tecnológica de Pereira, §5.1.1 and
    §5.2.3. ``docs/results/moa.md`` explains why its likelihood pools the recordings.

    M. A. Álvarez, L. Rosasco and N. D. Lawrence (2012), Kernels for Vector-Valued Functions: a
    Review, Foundations and Trends in Machine Learning 4(3): linear models of coregionalisation.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import MOA
    >>> from mocapbench.datasets import ToyProcess
    >>> rng = np.random.default_rng(0)
    >>> process = ToyProcess.random(rng, n_outputs=2, noise=0.01)
    >>> times = np.linspace(0.0, 6.0, 20)
    >>> children = process.draw(rng, times, 3)
    >>> model = MOA(kernel="rbf", max_iter=20).fit(children)
    >>> mean, variance = model.trend(times)
    >>> mean.shape, model.sample(times, 4, random_state=0).shape
    ((20, 2), (4, 20, 2))
    """

    def grow(self, names: Sequence[str]) -> Tree:
        """Return the one draw that all recordings depend on."""
        return {PARENT: [()] * len(names)}

    def reduce(self, replicates: Replicates) -> Reduction:
        """Return the likelihood of replicates in standard units as block problems."""
        return pool_replicates(replicates)

    def trend(self, times: Frames) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the posterior mean and variance of the one function at ``times`` (N,).

        Parameters
        ----------
        times : ndarray of shape (N,)
            In seconds, in any order.

        Returns
        -------
        mean, variance : ndarray of shape (N, D)
            In the outputs' own units and their squares, noise left out.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If times are not finite numbers.
        """
        check_is_fitted(self)
        return self._infer_curve(self.process_.reduction.trend, times)
