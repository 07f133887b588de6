r"""The hierarchical Gaussian process of Hensman et al., one for each channel (thesis §3.1.2).

Every recording is a child of one parent: :math:`g \sim \mathcal{GP}(0, k_g)`,
:math:`f_r \sim \mathcal{GP}(g, k_f)`, :math:`y_r = f_r + \varepsilon_r` (thesis eq. 5), or of a
group that is a child of the parent (eq. 8). Channels share nothing; unlike `MOHGP` it
has no coregionalisation.

J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017, is cited as the thesis.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.gp.channelwise import Channelwise
from mocapbench.baselines.gp.parameter_docs import document_like
from mocapbench.baselines.gp.reduction.tree import Path
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.baselines.protocols import Trended
from mocapbench.datasets import FrameByChannel, Frames

__all__ = ["HGP"]


@document_like(MOHGP)
@document_like(Channelwise)
@dataclass(kw_only=True, eq=False, repr=False)
class HGP(Channelwise[MOHGP], Trended):
    r"""Recordings vary around a common trend, a Gaussian process for each channel on its own.

    Attributes
    ----------
    models_ : tuple of D MOHGP
        The model of each channel.

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

    tree: Mapping[str, Path] | None = None
    sampled_trend: str = "mean"

    @staticmethod
    def of_one_channel() -> MOHGP:
        """Return an unfitted model of one channel."""
        return MOHGP(rank=0)

    def trend(self, times: Frames, group: Path = ()) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the posterior mean and variance of g or of a group, (N, D), as `MOHGP.trend`."""
        check_is_fitted(self)
        means, variances = zip(*(model.trend(times, group) for model in self.models_), strict=True)
        return np.hstack(means), np.hstack(variances)
