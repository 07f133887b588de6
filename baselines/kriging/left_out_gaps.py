r"""How well a Gaussian process predicts gaps that are left out, in closed form, with its gradient.

The likelihood of frames in a row says how well each is told from the one before, which is not what
is wanted of a gap. Here every frame belongs to one of several stretches, and each stretch in turn
is predicted from all the others.

With the covariance K (n, n) of the frames, noise included, its inverse P, values Z (n, O) and
:math:`A = P Z`, frames i of a stretch g that is left out have the errors
:math:`r_g = P_{gg}^{-1} A_g` and the covariance :math:`P_{gg}^{-1}` (C. E. Rasmussen and C. K. I.
Williams (2006), Gaussian Processes for Machine Learning, MIT Press, §5.4.2, with stretches in place
of points). With its diagonal s and one unknown scale, which is
:math:`\hat\sigma^2 = \operatorname{mean} r_{io}^2 / s_i`, the negative logarithm of the predictive
densities of all frames, each by itself, is

.. math::

    \tfrac12 n O \log \hat\sigma^2 + \tfrac12 O \sum_i \log s_i + \text{constant}.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.cholesky import invert
from mocapbench.basics.arrays import Array

__all__ = ["LeftOutGaps"]


_TINY = float(np.finfo(np.float64).tiny)


@dataclass(frozen=True, eq=False)
class LeftOutGaps:
    """What a process makes of each stretch of frames, given all the others.

    Parameters
    ----------
    covariance : ndarray of shape (n, n)
        K, positive definite, up to scale.
    values : ndarray of shape (n, O)
        Z, with mean zero.
    stretch : ndarray of int, shape (n,)
        The number of each frame's stretch.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the covariance is not numerically positive definite.
    """

    covariance: Array
    values: Array
    stretch: NDArray[np.intp]

    @cached_property
    def errors(self) -> Array:
        """(n, O) the values less their predictions."""
        return self._within @ self._dual

    @cached_property
    def variances(self) -> Array:
        """(n,) the variance of each prediction, up to scale."""
        return np.diagonal(self._within)

    @cached_property
    def scale(self) -> float:
        """The mean ratio of squared errors to variances; positive even where nothing errs."""
        return max(float(self.scales.mean()), _TINY)

    @property
    def scales(self) -> Array:
        """(O,) the mean ratio of squared errors to variances of each output."""
        return np.asarray((self.errors**2 / self.variances[:, None]).mean(axis=0))

    @property
    def score(self) -> float:
        """The negative log-density of the frames left out, each by itself; the less, the better."""
        n_frames, n_outputs = self.values.shape
        logarithms = n_frames * np.log(self.scale) + np.log(self.variances).sum()
        return float(0.5 * n_outputs * logarithms)

    @cached_property
    def sensitivity(self) -> Array:
        r"""(n, n) the derivatives of the `score` by the entries of the covariance.

        With :math:`\mathrm dP = -P\, \mathrm dK\, P`, stretches' inverses in the blocks of B,
        :math:`u_{io} = r_{io} / (\hat\sigma^2 s_i)` and
        :math:`h_i = \tfrac12 \sum_o (1 / s_i - r_{io}^2 / (\hat\sigma^2 s_i^2))`, it is the
        symmetric part of

        .. math:: P\,\bigl[(B u) r^\top + B \operatorname{diag}(h) B\bigr]_{\text{blocks}}\, P
            - P\, B u\, A^\top .
        """
        variances = self.variances[:, None]
        relative = self.errors / (self.scale * variances)
        by_variance = 0.5 * (1.0 / variances - relative * self.errors / variances).sum(axis=1)
        outward = self._within @ relative
        blocks = np.where(self._together, outward @ self.errors.T, 0.0)
        blocks += (self._within * by_variance) @ self._within
        precision = self._precision
        one_way = precision @ (blocks @ precision - outward @ self._dual.T)
        return np.asarray(0.5 * (one_way + one_way.T))

    @cached_property
    def _precision(self) -> Array:
        precision = np.array(self.covariance, order="C")
        invert(precision)
        return precision

    @cached_property
    def _dual(self) -> Array:
        return np.asarray(self._precision @ self.values)

    @cached_property
    def _together(self) -> NDArray[np.bool_]:
        return np.asarray(np.equal.outer(self.stretch, self.stretch))

    @cached_property
    def _within(self) -> Array:
        """(n, n) the covariance of each stretch given the others, in blocks; 0 elsewhere."""
        blocks = np.zeros_like(self._precision)
        for number in np.unique(self.stretch):
            frames = np.flatnonzero(self.stretch == number)
            place = np.ix_(frames, frames)
            blocks[place] = np.linalg.inv(self._precision[place])
        return blocks
