"""New trajectories from the learnt dynamics (GPDM §5.1).

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gpdm.dynamics import ConditionedDynamics
from mocapbench.baselines.gpdm.hmc import HybridMonteCarlo
from mocapbench.basics.arrays import Array

__all__ = ["fair_trajectories", "mean_trajectory", "roll_out"]


def roll_out(dynamics: ConditionedDynamics, x: Array, frames: NDArray[np.intp]) -> Array:
    """Return ``x`` (M, d) with ``frames`` replaced, in order, by the dynamics' conditional mean.

    Each of them is computed from the positions before it, replaced ones included. Before the
    first position of ``x``, that position is repeated.

    Parameters
    ----------
    dynamics : ConditionedDynamics
    x : ndarray of shape (M, d)
        A trajectory.
    frames : ndarray of int
        The frames to replace, each at least 1.
    """
    x = x.copy()
    lags = np.arange(1, dynamics.order + 1)
    for frame in frames:
        x[frame] = dynamics.step(x[np.maximum(frame - lags, 0)][None])[0][0]
    return x


def mean_trajectory(dynamics: ConditionedDynamics, first: Array, n_frames: int) -> Array:
    """Return the mean prediction (n_frames, d) from the positions ``first`` (order, d)."""
    x = np.zeros((n_frames, first.shape[1]))
    x[: len(first)] = first[:n_frames]
    return roll_out(dynamics, x, np.arange(len(first), n_frames))


def fair_trajectories(
    dynamics: ConditionedDynamics,
    first: Array,
    n_frames: int,
    sampler: HybridMonteCarlo,
    rng: np.random.Generator,
) -> Array:
    """Return trajectories (n, n_frames, d) drawn jointly, given their first positions.

    With the dynamics integrated out, the positions of a trajectory do not form a Markov chain and
    cannot be drawn one after another. The sampler draws whole trajectories, starting at the mean
    prediction.
    """
    start = mean_trajectory(dynamics, first, n_frames)
    n_first = min(len(first), n_frames)

    def potential(rest: Array) -> tuple[float, Array]:
        value, gradient = dynamics.negative_log_density(np.concatenate([start[:n_first], rest]))
        return value, gradient[n_first:]

    samples, _ = sampler.sample(potential, start[n_first:], rng)
    fixed = np.broadcast_to(start[:n_first], (len(samples), n_first, start.shape[1]))
    return np.concatenate([fixed, samples], axis=1)
