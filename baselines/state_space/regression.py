r"""Regression from expected moments, with a conjugate prior: each M-step here is one of these.

The model is :math:`y = B x + e`, :math:`e \sim N(0, V)`, given the sums :math:`S_{yy} = \sum
\langle y y^\top\rangle`, :math:`S_{yx}` and :math:`S_{xx}` over n frames. The prior counts as data:
:math:`\nu` frames with residuals of variance :math:`s^2`, and :math:`\lambda` frames in which each
regressor in turn is 1 and the response 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array

__all__ = ["Prior", "Regression", "Sums", "transpose_each"]


@dataclass(frozen=True)
class Prior:
    """The prior of a regression, as frames that nobody saw.

    Parameters
    ----------
    frames : float
        Their number ν, which weighs the prior of the noise.
    variance : float
        Their residual variance s².
    ridge : float
        The weight λ of coefficients of zero.
    """

    frames: float
    variance: float
    ridge: float


@dataclass(frozen=True, eq=False)
class Sums:
    """Expected moments of responses y (p) and regressors x (m), summed over frames.

    Parameters
    ----------
    yy, yx, xx : ndarray of shapes (…, p, p), (…, p, m) and (…, m, m)
        S_yy, S_yx and S_xx.
    count : ndarray of shape (…, 1, 1)
        Number n of frames.
    """

    yy: Array
    yx: Array
    xx: Array
    count: Array


@dataclass(frozen=True, eq=False)
class Regression:
    """Coefficients (…, p, m) and noise covariance (…, p, p)."""

    coefficients: Array
    covariance: Array

    @classmethod
    def of(cls, sums: Sums, prior: Prior) -> Regression:
        """Return the regression with the highest posterior density."""
        ridge = sums.xx + prior.ridge * np.eye(sums.xx.shape[-1])
        coefficients = transpose_each(np.linalg.solve(ridge, transpose_each(sums.yx)))
        # The residuals, λ B Bᵀ included: S_yy − B S_xy where B minimises.
        residual = sums.yy - coefficients @ transpose_each(sums.yx)
        residual = 0.5 * (residual + transpose_each(residual))
        scale = prior.frames * prior.variance * np.eye(residual.shape[-1])
        return cls(coefficients, (residual + scale) / (sums.count + prior.frames))

    def log_prior(self, prior: Prior) -> float:
        """Return −½ (ν log |V| + tr V⁻¹(ν s² I + λ B Bᵀ)), summed over the leading axes."""
        _, log_determinant = np.linalg.slogdet(self.covariance)
        squares = self.coefficients @ transpose_each(self.coefficients)
        scale = prior.frames * prior.variance * np.eye(squares.shape[-1]) + prior.ridge * squares
        trace = np.trace(np.linalg.solve(self.covariance, scale), axis1=-2, axis2=-1)
        return -0.5 * float(np.sum(prior.frames * log_determinant + trace))


def transpose_each(matrices: NDArray[Any]) -> Array:
    """Return the transpose of each matrix of (…, a, b)."""
    return np.swapaxes(matrices, -1, -2)
