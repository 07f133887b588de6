"""New trajectories from the learnt dynamics (GPDM §5.1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gpdm.dynamics import Motion
from mocapbench.baselines.gpdm.hmc import HybridMonteCarlo

__all__ = ["fair_trajectories", "followed", "mean_trajectory"]

Array = NDArray[np.float64]


def followed(motion: Motion, x: Array, frames: NDArray[np.intp]) -> Array:
    """Return ``x`` (M, d) with each of ``frames``, in order, at the mean of what comes next.

    The first position stands for those before it.
    """
    x = x.copy()
    lags = np.arange(1, motion.order + 1)
    for frame in frames:
        x[frame] = motion.step(x[np.maximum(frame - lags, 0)][None])[0][0]
    return x


def mean_trajectory(motion: Motion, first: Array, n_frames: int) -> Array:
    """Return the mean prediction sequence (n_frames, d) from the positions ``first`` (order, d)."""
    x = np.zeros((n_frames, first.shape[1]))
    x[: len(first)] = first[:n_frames]
    return followed(motion, x, np.arange(len(first), n_frames))


def fair_trajectories(
    motion: Motion, first: Array, n_frames: int, sampler: HybridMonteCarlo, rng: np.random.Generator
) -> Array:
    """Return trajectories (n, n_frames, d) drawn as wholes, given their first positions.

    With the dynamics integrated out a trajectory is no chain of transitions, so that a Markov
    chain of trajectories starts at the mean prediction.
    """
    start = mean_trajectory(motion, first, n_frames)
    n_first = min(len(first), n_frames)

    def potential(rest: Array) -> tuple[float, Array]:
        value, slope = motion.negative_log_density(np.concatenate([start[:n_first], rest]))
        return value, slope[n_first:]

    samples, _ = sampler.sample(potential, start[n_first:], rng)
    fixed = np.broadcast_to(start[:n_first], (len(samples), n_first, start.shape[1]))
    return np.concatenate([fixed, samples], axis=1)
