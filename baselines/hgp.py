r"""The hierarchical Gaussian process of Hensman et al., one a channel (thesis §3.1.2).

Every recording is a child of one parent: :math:`g \sim \mathcal{GP}(0, k_g)`,
:math:`f_r \sim \mathcal{GP}(g, k_f)`, :math:`y_r = f_r + \varepsilon_r` (thesis eq. 5), or of a
group that is a child of it (eq. 8). Channels share nothing: what it lacks beside `MOHGP` is
coregionalisation.
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
    """A hierarchy and noise for each channel on its own.

    Parameters and attributes are those of `Channelwise` and one more.

    Parameters
    ----------
    tree : mapping of str to sequence of str or None, default=None
        For the name of each recording the groups that it is in, as in `MOHGP`.
    sampled_trend : {"mean", "posterior"}, default="mean"
        The trends that `sample` draws new recordings around, as in `GaussianProcess`.

    References
    ----------
    Hensman, Lawrence and Rattray (2013), Hierarchical Bayesian modelling of gene expression time
    series across irregularly sampled replicates and clusters, BMC Bioinformatics 14.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.datasets import ToyProcess
    >>> rng = np.random.default_rng(0)
    >>> process = ToyProcess.random(rng, n_outputs=2, noise=0.01)
    >>> children = process.draw(rng, np.linspace(0.0, 6.0, 20), 3)
    >>> mean, variance = HGP(kernel="rbf").fit(children).trend(np.linspace(0.0, 6.0, 5))
    >>> mean.shape, variance.shape
    ((5, 2), (5, 2))
    """

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
        """Return the posterior mean and variance of g, or of a group, (N, D), as `MOHGP.trend`."""
        check_is_fitted(self)
        means, variances = zip(*(model.trend(times, group) for model in self.models_), strict=True)
        return np.hstack(means), np.hstack(variances)
