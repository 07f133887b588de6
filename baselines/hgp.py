r"""The hierarchical Gaussian process of Hensman et al., one for each channel (thesis §3.1.2).

Every recording is a child of one parent: :math:`g \sim \mathcal{GP}(0, k_g)`,
:math:`f_r \sim \mathcal{GP}(g, k_f)`, :math:`y_r = f_r + \varepsilon_r` (thesis eq. 5), or of a
group that is a child of the parent (eq. 8). Channels share nothing but by how much `impute` widens
variances; unlike `MOHGP` it has no
coregionalisation.

J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017, is cited as the thesis.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.gp.channelwise import Channelwise
from mocapbench.baselines.gp.reduction.tree import Path
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.baselines.protocols import Trended
from mocapbench.datasets import FrameByChannel, Frames

__all__ = ["HGP"]


class HGP(Channelwise[MOHGP], Trended):
    r"""Recordings vary around a common trend, a Gaussian process for each channel on its own.

    Parameters
    ----------
    tree : mapping of str to sequence of str or None, default=None
        For the name of each recording its groups, as in `MOHGP`.
    n_components : int or mapping of str to int, default=1
        Number of kernels that are added in every layer of a channel, or in each layer by its name,
        such as ``{"parent": 2, "child": 1}``.
    kernel : {"rbf", "matern12", "matern32", "matern52"}, default="matern32"
        The kernel of every component.
    n_restarts : int, default=1
        Number of searches for each channel; the first starts from the data.
    max_iter : int, default=1000
        Largest number of iterations of a search.
    tol : float, default=1e-7
        A search has converged when an iteration gains less than this fraction of the
        log-likelihood.
    max_seconds : float or None, default=None
        Time limit for all channels together, divided equally; None sets no limit.
    warm_start : bool, default=False
        Whether `fit` starts from the parameters of the previous one, if there was one.
    verbose : bool, default=False
        Whether `fit` prints a line for every iteration.
    solver : {"auto", "dense", "latent-split", "state-space"}, default="auto"
        How the likelihood is computed; "auto" takes the solver with the least work.
    sampled_trend : {"mean", "posterior"}, default="mean"
        The trend around which `sample` draws new recordings: its posterior mean, as in the thesis
        (§5.2), or one draw from its posterior, shared by all recordings of a call.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the random starts.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    models_ : tuple of D MOHGP
        The model of each channel.
    log_likelihood_ : float
        Log-likelihood of the recordings in their own units.
    converged_ : bool
        Whether every channel's search converged.
    n_iterations_, n_evaluations_ : int
        Totals over the channels.
    solver_ : str
        The solvers that were used.

    Notes
    -----
    With the trend g and recording r, channel by channel, and variances and kernels of each layer as
    in `GPIndependent`:

    .. math::

        g_d \sim \mathcal{GP}(0, k_{g, d}), \qquad
        f_{rd} \mid g_d \sim \mathcal{GP}(g_d, k_{f, d})

    .. math::

        y_{rd}(t) = f_{rd}(t) + \varepsilon, \qquad \varepsilon \sim N(0, \beta_d)

    ``docs/mathematics/inference.md`` has the inference.

    References
    ----------
    J. Hensman, N. D. Lawrence and M. Rattray (2013), Hierarchical Bayesian Modelling of Gene
    Expression Time Series across Irregularly Sampled Replicates and Clusters, BMC Bioinformatics
    14.

    J. D. Gil López (2017), Hierarchical Multiple Output Gaussian Processes for Human Motion Data,
    MSc thesis, Universidad Tecnológica de Pereira, §3.1.2,
    eq. (5) and (8).

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import HGP
    >>> from mocapbench.datasets import ToyProcess
    >>> rng = np.random.default_rng(0)
    >>> process = ToyProcess.random(rng, n_outputs=2, noise=0.01)
    >>> times = np.linspace(0.0, 6.0, 20)
    >>> children = process.draw(rng, times, 3)
    >>> model = HGP(kernel="rbf", max_iter=20).fit(children)
    >>> mean, variance = model.trend(np.linspace(0.0, 6.0, 5))
    >>> mean.shape, variance.shape
    ((5, 2), (5, 2))
    """

    max_frames = 200

    def __init__(
        self,
        *,
        tree: Mapping[str, Path] | None = None,
        n_components: int | Mapping[str, int] = 1,
        kernel: str = "matern32",
        n_restarts: int = 1,
        max_iter: int = 1000,
        tol: float = 1e-7,
        max_seconds: float | None = None,
        warm_start: bool = False,
        verbose: bool = False,
        solver: str = "auto",
        sampled_trend: str = "mean",
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        super().__init__(
            n_components=n_components,
            kernel=kernel,
            n_restarts=n_restarts,
            max_iter=max_iter,
            tol=tol,
            max_seconds=max_seconds,
            warm_start=warm_start,
            verbose=verbose,
            solver=solver,
            random_state=random_state,
        )
        self.tree = tree
        self.sampled_trend = sampled_trend

    @staticmethod
    def of_one_channel() -> MOHGP:
        """Return an unfitted model of one channel."""
        return MOHGP(rank=0)

    def trend(self, times: Frames, group: Path = ()) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the posterior mean and variance of g or of a group, (N, D), as `MOHGP.trend`."""
        check_is_fitted(self)
        means, variances = zip(*(model.trend(times, group) for model in self.models_), strict=True)
        return np.hstack(means), np.hstack(variances)
