"""The joint negative log-posterior of latent positions and parameters, GPDM eq. (27).

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.gpdm.dynamics import Dynamics
from mocapbench.baselines.gpdm.kernels import LatentKernel
from mocapbench.baselines.gpdm.regression import invert, negative_log_likelihood
from mocapbench.basics.arrays import Array

__all__ = ["JointPosterior", "PointEstimate"]


KAPPA = 1e3
"""The standard deviation κ of the half-normal prior of the scales, GPDM eq. (13)."""


@dataclass(frozen=True, eq=False)
class PointEstimate:
    """Values of all unknowns.

    Parameters
    ----------
    x : ndarray of shape (N, d)
        Latent positions.
    alpha, beta : ndarray
        Log-parameters of the dynamics and of the mapping to poses.
    scales : ndarray of shape (D,)
        The factor w of each channel.
    """

    x: Array
    alpha: Array
    beta: Array
    scales: Array


@dataclass(frozen=True, eq=False)
class JointPosterior:
    """The negative log-posterior of all unknowns, which learning minimises.

    Parameters
    ----------
    reconstruction : LatentKernel
        The covariance of the mapping from latent positions to poses.
    dynamics : Dynamics
        The prior of the latent positions.
    y : ndarray of shape (N, D)
        The stacked sequences, their mean subtracted.
    lengths : tuple of int
        Frames of each sequence.
    weight : float
        Factor of the dynamics' term L_X: 1, or D/d in the balanced model (GPDM §4.2).
    """

    reconstruction: LatentKernel
    dynamics: Dynamics
    y: Array
    lengths: tuple[int, ...]
    weight: float

    def value_and_gradients(
        self, estimate: PointEstimate
    ) -> tuple[float, tuple[Array, Array, Array]]:
        """Return L_Y + weight L_X + Σ ln α + Σ ln β, without terms in the scales alone.

        Its gradients follow, in x, α and β; the scales have none, see `best_scales`.
        """
        poses, (d_poses, _, d_beta) = negative_log_likelihood(
            self.reconstruction, estimate.beta, estimate.x, self.y * estimate.scales
        )
        prior, d_x, d_alpha = self.dynamics.negative_log_prior(
            estimate.alpha, estimate.x, self.lengths
        )
        value = poses + self.weight * prior + float(estimate.alpha.sum() + estimate.beta.sum())
        return value, (d_poses + self.weight * d_x, self.weight * d_alpha + 1.0, d_beta + 1.0)

    def inverse(self, x: Array, beta: Array) -> Array:
        """Return K_Y⁻¹ (N, N)."""
        gram, _ = self.reconstruction(beta[:-1], x, x)
        return invert(gram + np.exp(-beta[-1]) * np.eye(len(x)))[0]

    def best_scales(self, inverse: Array) -> Array:
        """Return the best w (D,) given K_Y⁻¹, or its mean over samples: GPDM Algorithms 1 and 2."""
        # Where the derivative of N ln w − ½ w² (yᵀ K⁻¹ y + 1 / κ²) is 0.
        quadratic = (self.y * (inverse @ self.y)).sum(axis=0)
        return np.asarray(np.sqrt(len(self.y) / (quadratic + 1.0 / KAPPA**2)))
