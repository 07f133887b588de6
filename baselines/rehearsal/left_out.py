r"""Visible entries left out one by one, and what their errors say of the claimed variances.

Maximum likelihood makes variances right on average over all recordings. One of them may be less
like the others than the rest are, and a plug-in process leaves out the doubt about its parameters.
So each visible entry of a recording is predicted from all others, with the parameters kept. Given
*all* entries, with the noise variance :math:`\beta` and :math:`K` the covariance of the entries,
the curve has at entry :math:`i` the mean :math:`\mu_i = y_i - \beta (K^{-1} y)_i` and the variance
:math:`v_i = \beta - \beta^2 (K^{-1})_{ii}`. The squared error over the variance of entry i, were
it left out, is then

.. math:: \frac{(K^{-1} y)_i^2}{(K^{-1})_{ii}} = \frac{(y_i - \mu_i)^2}{\beta - v_i} ,

and costs nothing (C. E. Rasmussen and C. K. I. Williams (2006), *Gaussian Processes for Machine
Learning*, eq. 5.12, has the left-hand side).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from mocapbench.baselines.protocols import Prediction
from mocapbench.baselines.rehearsal.ratios import mean_ratios
from mocapbench.baselines.rehearsal.variance_check import STEEPEST
from mocapbench.basics.arrays import Array
from mocapbench.basics.gaps import distances
from mocapbench.datasets import Mask, Recording

__all__ = ["LeftOut", "side_by_side"]


_RESOLVED = 1e-11
"""In standard units, the β (β − v) above which an entry counts: below, rounding of v may decide.

On walks of 39 channels the latent split knows v to 2e-13 / β or better
(``docs/mathematics/inference.md``).
"""
_AS_CLAIMED = 200
"""Entries as good as claimed that count besides, before variances become smaller.

``docs/calibration.md`` has the choice."""


@dataclass(frozen=True, eq=False)
class LeftOut:
    """What a process claims of a recording, and how well it predicts what is visible there.

    Parameters
    ----------
    claimed : Prediction
        With variances.
    squares : ndarray of shape (N, D)
        The squared error over the variance of each visible entry that is left out; NaN where it is
        hidden, or where rounding may decide because the noise is tiny.
    """

    claimed: Prediction
    squares: Array

    @classmethod
    def of(
        cls, recording: Recording, mean: Array, variance: Array, noise: Array, scale: Array
    ) -> Self:
        """Return the claims and the squares of a recording.

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
        squares = np.full(counted.shape, np.nan)
        np.divide((recording.values - mean) ** 2, beyond, out=squares, where=counted)
        return cls(Prediction.around(recording, mean, variance + noise), squares)

    @classmethod
    def side_by_side(cls, channels: Sequence[Self]) -> Self:
        """Return those of the channels of a recording as one."""
        return cls(
            side_by_side([channel.claimed for channel in channels]),
            np.hstack([channel.squares for channel in channels]),
        )

    def factors(self) -> Array:
        """Return what each channel's claimed variances are to be multiplied by: (D,).

        The mean square of the channel, in which the mean over all channels counts as ten entries
        (`mean_ratios`), but never less than what all entries together bear out.
        """
        counts = np.isfinite(self.squares).sum(axis=0)
        sums = np.nansum(self.squares, axis=0)
        if not counts.any():
            return np.ones(len(counts))
        return np.maximum(mean_ratios(sums, counts), self.least)

    @property
    def least(self) -> Array:
        """The least factors (D,) that all entries bear out, at most 1.

        200 entries that are as claimed count besides. Where the gaps of a channel lie farther from
        what is visible than visible entries do from each other, the ratio is taken to grow as
        steeply as trials ever let it; where nothing else of a channel is visible, it says nothing.
        """
        left_out = np.isfinite(self.squares)
        ratio = (np.nansum(self.squares) + _AS_CLAIMED) / (left_out.sum() + _AS_CLAIMED)
        gaps = np.asarray(self.claimed.variance) > 0.0
        visible = ~gaps
        there, here = _mean_distances(visible, gaps), _mean_distances(visible, visible)
        known = np.isfinite(there) & np.isfinite(here)
        farther = np.divide(there, here, out=np.full(len(here), np.inf), where=known)
        return np.asarray(np.minimum(ratio * np.maximum(farther, 1.0) ** STEEPEST, 1.0))


def _mean_distances(visible: Mask, entries: Mask) -> Array:
    """Return the mean number of frames from ``entries`` to the nearest other visible ones: (D,).

    It is infinite in channels where an entry has none, and 0 where there is no entry.
    """
    total = distances(~visible).sum(axis=0, where=entries)
    return np.asarray(total / np.maximum(entries.sum(axis=0), 1))


def side_by_side(channels: Sequence[Prediction]) -> Prediction:
    """Return the predictions of the channels of a recording, with variances, as one."""
    return Prediction(
        np.hstack([channel.mean for channel in channels]),
        np.hstack([np.asarray(channel.variance) for channel in channels]),
    )
