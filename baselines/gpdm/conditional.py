"""The distribution of a further sequence given the learnt model (GPDM §3.3)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gpdm.descent import descend
from mocapbench.baselines.gpdm.dynamics import Motion
from mocapbench.baselines.gpdm.posterior import Estimate, Posterior
from mocapbench.baselines.gpdm.process import Conditioned

__all__ = ["Conditional", "Query"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Query:
    """A sequence to fill, in the model's units: the mean subtracted, times the scales.

    Parameters
    ----------
    poses : ndarray of shape (M, D)
        Hidden frames hold anything finite.
    visible : ndarray of bool, shape (M,)
    """

    poses: Array
    visible: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Conditional:
    """The model given its training sequences.

    Parameters
    ----------
    x : ndarray of shape (N, d)
        Latent positions of the training frames.
    poses : ndarray of shape (N, D)
        The training frames in the model's units.
    lengths : tuple of int
        Frames of each training sequence.
    reconstruction : Conditioned
    motion : Motion
    weight : float
        What the prior of the trajectory is multiplied by, here as in learning.
    """

    x: Array
    poses: Array
    lengths: tuple[int, ...]
    reconstruction: Conditioned
    motion: Motion
    weight: float

    @classmethod
    def of(cls, posterior: Posterior, at: Estimate) -> Conditional:
        """Return the conditional model of an estimate."""
        poses = posterior.y * at.scales
        return cls(
            at.x,
            poses,
            posterior.lengths,
            posterior.reconstruction.conditioned(at.beta, at.x, poses),
            posterior.dynamics.conditioned(at.alpha, at.x, posterior.lengths),
            posterior.weight,
        )

    def negative_log_density(self, x: Array, query: Query) -> tuple[float, Array]:
        """Return −ln of (20) at the positions ``x`` (M, d) of a query, and its slope.

        Hidden poses are at their mean given the training and the visible frames (§5.4).
        """
        poses, d_poses, _ = self.reconstruction.negative_log_density(x, query.poses, query.visible)
        prior, d_prior = self.motion.negative_log_density(x)
        return poses + self.weight * prior, d_poses + self.weight * d_prior

    def improved(self, x: Array, query: Query, n_steps: int) -> Array:
        """Return the positions after ``n_steps`` downhill."""

        def objective(x: Array) -> tuple[float, Sequence[Array]]:
            value, slope = self.negative_log_density(x, query)
            return value, (slope,)

        return descend(objective, (x,), n_steps)[0]

    def predecessors(self) -> Array:
        """Return each training frame's history (N, order, d), the last position first.

        Where a sequence begins, its first position stands for those before it.
        """
        frames = np.concatenate([np.arange(length) for length in self.lengths])
        rows = np.arange(len(frames))[:, None]
        lags = np.arange(self.motion.order)
        return np.asarray(self.x[rows - np.minimum(lags, frames[:, None])])
