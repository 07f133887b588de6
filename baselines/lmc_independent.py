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
from mocapbench.baselines.gp.prior.parameters import CHILD
from mocapbench.baselines.gp.reduction.independent import independent
from mocapbench.baselines.gp.reduction.reduction import Reduction
from mocapbench.baselines.gp.reduction.replicates import Replicates
from mocapbench.baselines.gp.reduction.tree import Tree

__all__ = ["LMCIndependent"]


class LMCIndependent(GaussianProcess):
    r"""A Gaussian process over all channels, of which recordings are independent draws.

    `impute` conditions each recording on its own visible entries, with variances that they bear
    out (`as_claimed` has the posterior itself). `sample` draws from the prior.

    Parameters
    ----------
    n_components : int or mapping of str to int, default=1
        Number Q of components of every layer, or of each layer by its name, such as
        ``{"child": 3}``.
    rank : int, default=1
        Number of columns of each factor W_q; 0 makes the outputs independent.
    kernel : {"rbf", "matern12", "matern32", "matern52"}, default="matern32"
        The kernel of every component.
    n_restarts : int, default=1
        Number of searches. The first starts from the data, the next four with its lengthscales
        assigned otherwise, the others at random around it. Of starts that are the same, as with one
        component, one is searched.
    max_iter : int, default=1000
        Largest number of iterations of a search.
    tol : float, default=1e-7
        A search has converged when an iteration gains less than this fraction of the
        log-likelihood.
    max_seconds : float or None, default=None
        Time limit for all searches together; None sets no limit. Results then depend on the
        machine. An evaluation of the likelihood that has begun is finished first: with "rbf" it
        takes time with the cube of the frames, with Matérn kernels in proportion to them.
    warm_start : bool, default=False
        Whether `fit` starts from the parameters of the previous one, if there was one.
    verbose : bool, default=False
        Whether `fit` prints a line for every iteration.
    solver : {"auto", "dense", "latent-split", "state-space", "kronecker"}, default="auto"
        How the likelihood is computed; "auto" takes the solver with the least work.
    sampled_trend : {"mean", "posterior"}, default="mean"
        Not used: this model has no trend.
    n_jobs : int or None, default=None
        Number of threads over outputs; it does not affect results. None means 1, unless in a
        ``joblib.parallel_config`` context; −1 means all processors.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the random starts.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    parameters_ : Parameters
        Maximum-likelihood parameters, for outputs in standard units.
    log_likelihood_ : float
        Log-likelihood of the recordings in their own units.
    bic_ : float
        Schwarz's criterion, −2 log L + k log n for k parameters and n visible entries; lower is
        better.
    training_ : Training
        The searches, with the log-likelihood after each iteration.
    converged_, n_iterations_, n_evaluations_ : bool, int, int
        Those of the best search.
    solver_, engine_ : str
        The solvers that were used, without and with their counted work.
    coregionalisation_ : dict of str to ndarray of shape (Q, D, D)
        The matrices B_q of each layer, in the outputs' own units.
    noise_ : ndarray of shape (D,)
        Noise variances, in the outputs' own units.

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

    max_frames = 200

    def grow(self, names: Sequence[str]) -> Tree:
        """Return one draw for every recording."""
        return {CHILD: [(name,) for name in names]}

    def reduce(self, replicates: Replicates) -> Reduction:
        """Return the likelihood of replicates in standard units as block problems."""
        return independent(replicates)
