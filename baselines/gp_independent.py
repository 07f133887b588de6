r"""One Gaussian process for each channel, with nothing shared between channels or recordings.

The parameters of a channel are learnt from all recordings, as independent draws. The prediction of
a recording uses that recording alone. A model that does not outperform it gains nothing from other
channels or recordings.
"""

from __future__ import annotations

from mocapbench.baselines.gp.channelwise import Channelwise
from mocapbench.baselines.gp.parameter_docs import document_like
from mocapbench.baselines.lmc_independent import LMCIndependent

__all__ = ["GPIndependent"]


@document_like(Channelwise)
class GPIndependent(Channelwise[LMCIndependent]):
    r"""A Gaussian process with noise for each channel on its own.

    Attributes
    ----------
    models_ : tuple of D LMCIndependent
        The model of each channel.

    Notes
    -----
    Channel d of every recording is a draw of its own of one process, with variances :math:`b_{qd}`
    and kernels :math:`k_{qd}` of unit variance:

    .. math::

        f_d \sim \mathcal{GP}\Bigl(0, \sum_q b_{qd} k_{qd}\Bigr), \qquad
        y_d(t) = f_d(t) + \varepsilon, \quad \varepsilon \sim N(0, \beta_d)

    ``docs/mathematics/inference.md`` has the inference.

    References
    ----------
    C. E. Rasmussen and C. K. I. Williams (2006), Gaussian Processes for Machine Learning, MIT
    Press: prediction eq. (2.25) and (2.26), training eq. (5.8) and (5.9).

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import GPIndependent
    >>> from mocapbench.datasets import ToyProcess
    >>> rng = np.random.default_rng(0)
    >>> process = ToyProcess.random(rng, n_outputs=2, noise=0.01)
    >>> times = np.linspace(0.0, 6.0, 20)
    >>> children = process.draw(rng, times, 3)
    >>> hidden = np.zeros((20, 2), dtype=bool)
    >>> hidden[8:12] = True
    >>> incomplete = children[0].hide(hidden)
    >>> model = GPIndependent(kernel="rbf", max_iter=20).fit([incomplete, *children[1:]])
    >>> (prediction,) = model.impute([incomplete])
    >>> prediction.mean.shape, bool((prediction.variance[hidden] > 0).all())
    ((20, 2), True)
    """

    @staticmethod
    def of_one_channel() -> LMCIndependent:
        """Return an unfitted model of one channel."""
        return LMCIndependent(rank=0)
