r"""The parameters of a linear Gaussian state-space model, their weak priors, and what they imply.

Each of the three parts of the model is a regression :math:`y = B x + e`, :math:`e \sim N(0, V)`,
which is learnt from the sums :math:`S_{yy} = \sum \langle y y^\top\rangle`, :math:`S_{yx}` and
:math:`S_{xx}` over n frames. Its conjugate prior counts as data: :math:`\nu` frames with residuals
of variance :math:`s^2`, and :math:`\lambda` frames in which each regressor in turn is 1 and the
response 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array

__all__ = [
    "PRIORS",
    "Prior",
    "Priors",
    "StateSpaceParameters",
    "Sums",
    "draw_sequences",
    "entry_moments",
    "log_prior_density",
    "regress",
    "transpose_each",
]

Sums = tuple[Array, Array, Array, Array]
"""S_yy (…, p, p), S_yx (…, p, m), S_xx (…, m, m) and the number n of frames (…, 1, 1)."""


Prior = tuple[float, float, float]
"""Frames that nobody saw: their number ν, which weighs the prior of the noise, their residual
variance s², and the weight λ of coefficients of zero."""
Priors = tuple[Prior, Prior, Prior]
"""Of the first state, a regression on 1; of the next state on the state; of each channel on the
state and 1."""

PRIORS: Priors = ((10.0, 1.0, 1.0), (1.0, 1e-2, 1e-2), (10.0, 1.0, 1.0))
"""A recording is one frame of the start, so that a few recordings leave it nearly N(0, I)."""


@dataclass(frozen=True, eq=False)
class StateSpaceParameters:
    """The parameters of the model of q states and D channels.

    Parameters
    ----------
    first : ndarray of shape (q, 1)
        Mean m of the first state.
    first_covariance : ndarray of shape (q, q)
        Covariance P of the first state.
    transition : ndarray of shape (q, q)
        A.
    transition_covariance : ndarray of shape (q, q)
        Covariance Q of the noise of a step.
    emission : ndarray of shape (D, 1, q + 1)
        The row of (C, d) of each channel.
    emission_covariance : ndarray of shape (D, 1, 1)
        The variance r of each channel's noise.
    """

    first: Array
    first_covariance: Array
    transition: Array
    transition_covariance: Array
    emission: Array
    emission_covariance: Array

    @property
    def n_states(self) -> int:
        """The number q of states."""
        return len(self.transition)

    @property
    def loadings(self) -> Array:
        """C (D, q)."""
        return self.emission[:, 0, :-1]

    @property
    def offset(self) -> Array:
        """The offset d (D,) of the channels."""
        return self.emission[:, 0, -1]

    @property
    def noise(self) -> Array:
        """The variance r (D,) of the channels' noise."""
        return self.emission_covariance[:, 0, 0]

    @cached_property
    def squares(self) -> Array:
        """(D, q²) the outer product of each channel's loadings with themselves."""
        products = self.loadings[:, :, None] * self.loadings[:, None, :]
        return np.asarray(products.reshape(len(products), -1))

    def log_prior(self, priors: Priors) -> float:
        """Return the log-density of the priors up to a constant."""
        start, dynamics, emission = priors
        return (
            log_prior_density(self.first, self.first_covariance, start)
            + log_prior_density(self.transition, self.transition_covariance, dynamics)
            + log_prior_density(self.emission, self.emission_covariance, emission)
        )


def regress(sums: Sums, prior: Prior) -> tuple[Array, Array]:
    """Return the most probable coefficients (…, p, m) and noise covariance (…, p, p)."""
    (yy, yx, xx, count), (frames, variance, ridge) = sums, prior
    # B = S_yx (S_xx + λ I)⁻¹
    gram = xx + ridge * np.eye(xx.shape[-1])
    coefficients = transpose_each(np.linalg.solve(gram, transpose_each(yx)))
    # The residuals, λ B Bᵀ included: S_yy − B S_xy where B minimises.
    residual = yy - coefficients @ transpose_each(yx)
    residual = 0.5 * (residual + transpose_each(residual))
    # V = (residuals + ν s² I) / (n + ν)
    scale = frames * variance * np.eye(residual.shape[-1])
    return coefficients, (residual + scale) / (count + frames)


def entry_moments(
    parameters: StateSpaceParameters, mean: Array, covariance: Array
) -> tuple[Array, Array]:
    """Return the mean and variance of every entry, noise included: (K, N, D) each.

    Parameters
    ----------
    parameters : StateSpaceParameters
    mean, covariance : ndarray of shapes (K, N, q) and (K, N, q, q)
        Those of the states.
    """
    # c_d' P c_d of all channels at once, as products of P and c_d c_d'.
    signal = covariance.reshape(*covariance.shape[:2], -1) @ parameters.squares.T
    variance = np.maximum(signal, 0.0) + parameters.noise
    return mean @ parameters.loadings.T + parameters.offset, variance


def draw_sequences(
    parameters: StateSpaceParameters, n_samples: int, n_frames: int, rng: np.random.Generator
) -> Array:
    """Return new sequences in standard units, noise included: (n, N, D)."""
    q, n_channels = parameters.n_states, len(parameters.noise)
    # x_1 = m + P^½ u and x_{t+1} = A x_t + Q^½ w_t, then y_t = C x_t + d + noise.
    shocks = rng.standard_normal((n_frames, n_samples, q))
    noise = rng.standard_normal((n_samples, n_frames, n_channels)) * np.sqrt(parameters.noise)
    first = shocks[0] @ np.linalg.cholesky(parameters.first_covariance).T
    states = [parameters.first[:, 0] + first]
    later = shocks[1:] @ np.linalg.cholesky(parameters.transition_covariance).T
    for shock in later:
        states.append(states[-1] @ parameters.transition.T + shock)
    paths = np.stack(states, axis=1)
    return np.asarray(paths @ parameters.loadings.T + parameters.offset + noise)


def log_prior_density(coefficients: Array, covariance: Array, prior: Prior) -> float:
    """Return −½ (ν log |V| + tr V⁻¹(ν s² I + λ B Bᵀ)), summed over the leading axes."""
    frames, variance, ridge = prior
    _, log_determinant = np.linalg.slogdet(covariance)
    squares = coefficients @ transpose_each(coefficients)
    scale = frames * variance * np.eye(squares.shape[-1]) + ridge * squares
    trace = np.trace(np.linalg.solve(covariance, scale), axis1=-2, axis2=-1)
    return -0.5 * float(np.sum(frames * log_determinant + trace))


def transpose_each(matrices: NDArray[Any]) -> Array:
    """Return the transpose of each matrix of (…, a, b)."""
    return np.swapaxes(matrices, -1, -2)
