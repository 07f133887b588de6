r"""A Gaussian process over frames, given its values at some of them.

All channels share the covariance up to a scale, :math:`\sigma_d^2 K`. With the prior
:math:`p(\sigma_d^2) \propto 1 / \sigma_d^2` the scale is integrated out: the prediction of a
channel is a Student t with n degrees of freedom, n being the number of visible frames. Its
variance is
:math:`n / (n - 2)` times that with the maximum-likelihood scale :math:`r^\top K^{-1} r / n`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from mocapbench.baselines.kriging.student import student_variance
from mocapbench.basics.arrays import Array

__all__ = ["ConditionedFrames"]


@dataclass(frozen=True, eq=False)
class ConditionedFrames:
    """The distribution of all N frames given the n visible ones.

    Parameters
    ----------
    prior : ndarray of shape (N, N)
        Covariance between frames, noise left out, up to scale.
    noise : float
        Variance of the noise, up to the same scale; positive.
    visible : ndarray of bool, shape (N,)
        Which frames are visible; at least one.
    """

    prior: Array
    noise: float
    visible: NDArray[np.bool_]

    @cached_property
    def _factor(self) -> tuple[Array, Any]:
        n_visible = int(self.visible.sum())
        among = self.prior[np.ix_(self.visible, self.visible)]
        return cho_factor(among + self.noise * np.eye(n_visible), lower=True)

    def mean(self, residuals: Array) -> Array:
        """Return the mean (N, D) given residuals (n, D) at the visible frames."""
        return np.asarray(self.prior[:, self.visible] @ cho_solve(self._factor, residuals))

    @cached_property
    def variance(self) -> Array:
        """(N,) variance of each frame, noise included, up to scale."""
        cross = self.prior[:, self.visible]
        explained = (cross * cho_solve(self._factor, cross.T).T).sum(axis=1)
        return np.asarray(np.diagonal(self.prior) + self.noise - explained)

    def scales(self, residuals: Array, least: float) -> Array:
        """Return the maximum-likelihood scale of each channel (D,), at least ``least``."""
        dual = cho_solve(self._factor, residuals)
        return np.asarray(np.maximum((residuals * dual).mean(axis=0), least))

    def log_evidence(self, scales: Array) -> Array:
        """Return the log-density of each channel (D,), its scale integrated out, up to a constant.

        Parameters
        ----------
        scales : ndarray of shape (D,)
            As `scales` returns them.
        """
        half_log_determinant = np.log(np.diagonal(self._factor[0])).sum()
        return np.asarray(-0.5 * self.visible.sum() * np.log(scales) - half_log_determinant)

    @property
    def doubt_of_scale(self) -> float:
        """By what the variance grows because the scale is inferred: n / (n − 2) if n > 2."""
        return student_variance(int(self.visible.sum()))
