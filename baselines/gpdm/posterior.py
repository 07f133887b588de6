"""The joint negative log-posterior of latent positions and parameters, GPDM (27)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gpdm.dynamics import Dynamics
from mocapbench.baselines.gpdm.process import Process, invert

__all__ = ["Estimate", "Posterior", "PosteriorSlopes"]

Array = NDArray[np.float64]

KAPPA = 1e3
"""The width κ of the half-normal prior (13) of the scales."""


@dataclass(frozen=True, eq=False)
class Estimate:
    """A point in the space of all unknowns.

    Parameters
    ----------
    x : ndarray of shape (N, d)
        Latent positions.
    alpha, beta : ndarray
        Log-parameters of the dynamics and of the reconstruction.
    scales : ndarray of shape (D,)
        The w of each channel.
    """

    x: Array
    alpha: Array
    beta: Array
    scales: Array


@dataclass(frozen=True, eq=False)
class PosteriorSlopes:
    """The negative log-posterior and its slopes, those of the scales apart."""

    value: float
    x: Array
    alpha: Array
    beta: Array


@dataclass(frozen=True, eq=False)
class Posterior:
    """What learning minimises.

    Parameters
    ----------
    reconstruction : Process
        From latent positions to poses.
    dynamics : Dynamics
    y : ndarray of shape (N, D)
        The stacked sequences, their mean subtracted.
    lengths : tuple of int
        Frames of each sequence.
    weight : float
        What L_X is multiplied by: 1, or D/d in the balanced model (§4.2).
    """

    reconstruction: Process
    dynamics: Dynamics
    y: Array
    lengths: tuple[int, ...]
    weight: float

    def slopes(self, at: Estimate) -> PosteriorSlopes:
        """Return L_Y + weight L_X + Σ ln α + Σ ln β, without terms in the scales alone."""
        poses = self.reconstruction.negative_log_likelihood(at.beta, at.x, self.y * at.scales)
        prior, d_x, d_alpha = self.dynamics.negative_log_prior(at.alpha, at.x, self.lengths)
        return PosteriorSlopes(
            poses.value + self.weight * prior + float(at.alpha.sum() + at.beta.sum()),
            poses.inputs + self.weight * d_x,
            self.weight * d_alpha + 1.0,
            poses.theta + 1.0,
        )

    def inverse(self, x: Array, beta: Array) -> Array:
        """Return K_Y⁻¹ (N, N)."""
        gram, _ = self.reconstruction.kernel(beta[:-1], x, x)
        return invert(gram + np.exp(-beta[-1]) * np.eye(len(x)))[0]

    def best_scales(self, inverse: Array) -> Array:
        """Return w given K_Y⁻¹, or its mean over samples: Algorithms 1 and 2."""
        quadratic = (self.y * (inverse @ self.y)).sum(axis=0)
        return np.asarray(np.sqrt(len(self.y) / (quadratic + 1.0 / KAPPA**2)))
