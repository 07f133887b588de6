"""Learning algorithms (GPDM §4), each an object that computes an estimate from a joint posterior.

All stop after a stated number of iterations. The kernel parameters drift for thousands of
iterations, so that this number is part of the model (early stopping).

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import replace
from typing import ClassVar

import numpy as np

from mocapbench.baselines.gpdm.descent import descend
from mocapbench.baselines.gpdm.posterior import JointPosterior, PointEstimate
from mocapbench.basics.arrays import Array

__all__ = ["Balanced", "FixedDynamics", "Learning", "MaximumAPosteriori", "with_best_scales"]


class Learning(ABC):
    """A learning algorithm."""

    def weight(self, n_channels: int, n_latent: int) -> float:
        """Return the factor of the trajectories' log-prior."""
        del n_channels, n_latent
        return 1.0

    @abstractmethod
    def learn(
        self, posterior: JointPosterior, start: PointEstimate, rng: np.random.Generator
    ) -> PointEstimate:
        """Return an estimate of all unknowns, found from ``start``."""


def with_best_scales(posterior: JointPosterior, estimate: PointEstimate) -> PointEstimate:
    """Return the estimate with the scales that maximise the posterior given the rest of it."""
    return replace(
        estimate, scales=posterior.best_scales(posterior.inverse(estimate.x, estimate.beta))
    )


class MaximumAPosteriori(Learning):
    """GPDM Algorithm 1: alternate the scales in closed form with L-BFGS on all other unknowns.

    Parameters
    ----------
    n_rounds, n_steps : int
        Rounds, and iterations of L-BFGS in a round: the paper's I = 100 and J = 10. L-BFGS takes
        the place of the paper's scaled conjugate gradients.
    """

    def __init__(self, n_rounds: int, n_steps: int) -> None:
        self.n_rounds: int = n_rounds
        self.n_steps: int = n_steps

    def learn(
        self, posterior: JointPosterior, start: PointEstimate, rng: np.random.Generator
    ) -> PointEstimate:
        """Return the estimate after all rounds."""
        del rng
        estimate = start
        for _ in range(self.n_rounds):
            estimate = self._run_round(posterior, with_best_scales(posterior, estimate))
        return estimate

    def _run_round(self, posterior: JointPosterior, estimate: PointEstimate) -> PointEstimate:
        def objective(x: Array, alpha: Array, beta: Array) -> tuple[float, Sequence[Array]]:
            return posterior.value_and_gradients(PointEstimate(x, alpha, beta, estimate.scales))

        x, alpha, beta = descend(
            objective, (estimate.x, estimate.alpha, estimate.beta), self.n_steps
        )
        return PointEstimate(x, alpha, beta, estimate.scales)


class Balanced(MaximumAPosteriori):
    """GPDM §4.2: the log-prior of the trajectories is multiplied by D/d, to balance the poses."""

    def weight(self, n_channels: int, n_latent: int) -> float:
        """Return D/d."""
        return n_channels / n_latent


class FixedDynamics(MaximumAPosteriori):
    """GPDM §4.3: the parameters of the dynamics are set by hand, and the rest is learnt."""

    alpha: ClassVar[tuple[float, ...]] = (0.009, 0.2, 0.001, 1e6)
    """Those of the paper, of first-order dynamics with a linear and an RBF kernel."""

    def learn(
        self, posterior: JointPosterior, start: PointEstimate, rng: np.random.Generator
    ) -> PointEstimate:
        """Return the estimate after all rounds.

        Raises
        ------
        ValueError
            If the dynamics do not have as many parameters as there are values.
        """
        if len(start.alpha) != len(self.alpha):
            raise ValueError(
                f"expected dynamics with {len(self.alpha)} parameters, for which fixed-alpha has "
                f"values, got {len(start.alpha)}; use first-order linear+rbf dynamics"
            )
        return super().learn(posterior, replace(start, alpha=np.log(self.alpha)), rng)

    def _run_round(self, posterior: JointPosterior, estimate: PointEstimate) -> PointEstimate:
        def objective(x: Array, beta: Array) -> tuple[float, Sequence[Array]]:
            point = PointEstimate(x, estimate.alpha, beta, estimate.scales)
            value, (d_x, _, d_beta) = posterior.value_and_gradients(point)
            return value, (d_x, d_beta)

        x, beta = descend(objective, (estimate.x, estimate.beta), self.n_steps)
        return PointEstimate(x, estimate.alpha, beta, estimate.scales)
