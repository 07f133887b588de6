"""The distribution of a further sequence given the learnt model (GPDM §3.3).

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gpdm.descent import descend
from mocapbench.baselines.gpdm.dynamics import ConditionedDynamics
from mocapbench.baselines.gpdm.posterior import JointPosterior, PointEstimate
from mocapbench.baselines.gpdm.regression import ConditionedProcess, condition_process
from mocapbench.basics.arrays import Array

__all__ = ["Conditional", "Query"]

Query = tuple[Array, NDArray[np.bool_]]
"""A sequence to fill: poses (M, D) in the model's units, the mean subtracted, times the scales, and
which of its frames (M,) are visible. Hidden poses may hold any finite values; they are not read."""


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
    reconstruction : ConditionedProcess
        The mapping from latent positions to poses, given the training frames.
    dynamics : ConditionedDynamics
        The prior of a new trajectory, given the training trajectories.
    weight : float
        Factor of the trajectory's log-prior, the same as in learning.
    """

    x: Array
    poses: Array
    lengths: tuple[int, ...]
    reconstruction: ConditionedProcess
    dynamics: ConditionedDynamics
    weight: float

    @classmethod
    def of(cls, posterior: JointPosterior, estimate: PointEstimate) -> Conditional:
        """Return the conditional model of an estimate."""
        poses = posterior.y * estimate.scales
        return cls(
            estimate.x,
            poses,
            posterior.lengths,
            condition_process(posterior.reconstruction, estimate.beta, estimate.x, poses),
            posterior.dynamics.condition(estimate.alpha, estimate.x, posterior.lengths),
            posterior.weight,
        )

    def negative_log_density(self, x: Array, query: Query) -> tuple[float, Array]:
        """Return −ln of GPDM (20) at the positions ``x`` (M, d) of a query, and its gradient.

        Hidden poses take their mean given the training and the visible frames (GPDM §5.4).
        """
        poses, d_poses, _ = self.reconstruction.negative_log_density(x, *query)
        prior, d_prior = self.dynamics.negative_log_density(x)
        return poses + self.weight * prior, d_poses + self.weight * d_prior

    def optimise(self, x: Array, query: Query, n_steps: int) -> Array:
        """Return the positions after at most ``n_steps`` iterations of L-BFGS from ``x``."""

        def objective(x: Array) -> tuple[float, Sequence[Array]]:
            value, gradient = self.negative_log_density(x, query)
            return value, (gradient,)

        return descend(objective, (x,), n_steps)[0]

    def predecessors(self) -> Array:
        """Return the positions before each training frame's successor: (N, order, d).

        The frame's own position comes first, then earlier ones. At the beginning of a sequence
        its first position is repeated.
        """
        frames = np.concatenate([np.arange(length) for length in self.lengths])
        rows = np.arange(len(frames))[:, None]
        lags = np.arange(self.dynamics.order)
        return np.asarray(self.x[rows - np.minimum(lags, frames[:, None])])
