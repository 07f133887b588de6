"""What the model says about channels: means and variances of entries, and new recordings."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.state_space.model import StateSpaceParameters
from mocapbench.baselines.state_space.smoothing import Smoothed
from mocapbench.basics.arrays import Array

__all__ = ["draw_sequences", "moments"]


def moments(parameters: StateSpaceParameters, posterior: Smoothed) -> tuple[Array, Array]:
    """Return the mean and variance of every entry, noise included: (K, N, D) each."""
    mean = posterior.mean @ parameters.loadings.T + parameters.offset
    shape = posterior.covariance.shape
    # c_d' P c_d of all channels at once, as products of P and c_d c_d'.
    signal = posterior.covariance.reshape(*shape[:2], -1) @ parameters.squares.T
    return mean, np.maximum(signal, 0.0) + parameters.noise


def draw_sequences(
    parameters: StateSpaceParameters, n_samples: int, n_frames: int, rng: np.random.Generator
) -> Array:
    """Return new sequences in standard units, noise included: (n, N, D)."""
    q, n_channels = parameters.n_states, len(parameters.noise)
    shocks = rng.standard_normal((n_frames, n_samples, q))
    noise = rng.standard_normal((n_samples, n_frames, n_channels)) * np.sqrt(parameters.noise)
    first = shocks[0] @ np.linalg.cholesky(parameters.start.covariance).T
    states = [parameters.start.coefficients[:, 0] + first]
    later = shocks[1:] @ np.linalg.cholesky(parameters.dynamics.covariance).T
    for shock in later:
        states.append(states[-1] @ parameters.dynamics.coefficients.T + shock)
    paths = np.stack(states, axis=1)
    return np.asarray(paths @ parameters.loadings.T + parameters.offset + noise)
