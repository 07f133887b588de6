r"""MOA, the reference model of the thesis: one multiple-output Gaussian process.

All recordings are noisy observations of the *same* function, :math:`g \sim \mathcal{GP}(0, K_g)`,
:math:`y_r = g + \varepsilon_r`. Differences between recordings count as noise, which explains its
large interpolation errors (thesis §5.1).

J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017, is cited as the thesis.
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
    r"""A Gaussian process over all channels; recordings are noisy copies of one function.

    `trend` gives the posterior of that function, and so does `impute`, with variances that the
    visible entries of a recording bear out (`as_claimed` has the posterior itself). `sample` takes
    its posterior mean as the trend and draws with the prior covariance around it, as the thesis
    does (§5.2): samples differ by as much as the function varies, where recordings, by the model
    that is fitted, differ by noise alone.

    Parameters
    ----------
    n_components : int or mapping of str to int, default=1
        Number Q of components of every layer, or of each layer by its name, such as
        ``{"parent": 3}``.
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
        The trend around which `sample` draws new recordings: its posterior mean, as in the thesis
        (§5.2), or one draw from its posterior, shared by all recordings of a call.
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

    max_frames = 200

    def grow(self, names: Sequence[str]) -> Tree:
        """Return the one draw that all recordings depend on."""
        return {PARENT: [()] * len(names)}

    def reduce(self, replicates: Replicates) -> Reduction:
        """Return the likelihood of replicates in standard units as block problems."""
        return pooled(replicates)
