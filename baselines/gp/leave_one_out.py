r"""The visible entries of a recording, each predicted from all others, in closed form.

Given *all* entries, with the noise variance :math:`\beta` and :math:`K` the covariance of the
entries, the curve has at entry :math:`i` the mean :math:`\mu_i = y_i - \beta (K^{-1} y)_i` and the
variance :math:`v_i = \beta - \beta^2 (K^{-1})_{ii}`. The squared error over the variance of entry
i, were it left out with the parameters kept, is then

.. math:: \frac{(K^{-1} y)_i^2}{(K^{-1})_{ii}} = \frac{(y_i - \mu_i)^2}{\beta - v_i} ,

and costs nothing (C. E. Rasmussen and C. K. I. Williams (2006), *Gaussian Processes for Machine
Learning*, eq. 5.12, has the left-hand side).
"""

from __future__ import annotations

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["leave_one_out_ratios"]

_RESOLVED = 1e-11
"""In standard units, the β (β − v) above which an entry counts: below, rounding of v may decide.

On walks of 39 channels the latent split knows v to 2e-13 / β or better
(``docs/mathematics/prediction.md``).
"""


def leave_one_out_ratios(
    recording: Recording, mean: Array, variance: Array, noise: Array, scale: Array
) -> Array:
    """Return the squared error over the variance of each visible entry that is left out: (N, D).

    It is NaN where an entry is hidden, or where rounding may decide because the noise is tiny.

    Parameters
    ----------
    recording : Recording
    mean, variance : ndarray of shape (N, D)
        Of its noise-free curve, given all visible entries.
    noise : ndarray of shape (D,)
        Variance of the noise.
    scale : ndarray of shape (D,)
        Standard deviation of each channel, over all recordings.
    """
    beyond = noise - variance  # β − v
    counted = recording.visible & (noise * beyond > _RESOLVED * scale**4)
    ratios = np.full(counted.shape, np.nan)
    np.divide((recording.values - mean) ** 2, beyond, out=ratios, where=counted)
    return ratios
