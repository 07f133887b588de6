"""Four ways to learn the unknowns (GPDM §4), each an object that takes a posterior to an estimate.

All stop after a stated number of iterations: the kernels' parameters drift for thousands of them,
so the number is part of the model (early stopping).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gpdm.descent import descend
from mocapbench.baselines.gpdm.posterior import Estimate, Posterior

__all__ = ["Balanced", "FixedDynamics", "Learning", "MaximumAPosteriori", "with_best_scales"]

Array = NDArray[np.float64]


class Learning(ABC):
    """A way to learn."""

    def weight(self, n_channels: int, n_latent: int) -> float:
        """Return what the prior of the trajectories is multiplied by."""
        del n_channels, n_latent
        return 1.0

    @abstractmethod
    def learn(self, posterior: Posterior, start: Estimate, rng: np.random.Generator) -> Estimate:
        """Return an estimate of all unknowns."""


def with_best_scales(posterior: Posterior, at: Estimate) -> Estimate:
    """Return the estimate with the scales that are best for the rest of it."""
    return replace(at, scales=posterior.best_scales(posterior.inverse(at.x, at.beta)))


@dataclass(frozen=True)
class MaximumAPosteriori(Learning):
    """Algorithm 1: in turn the scales in closed form, and steps in everything else.

    Parameters
    ----------
    n_rounds, n_steps : int
        The paper's I = 100 and J = 10; L-BFGS takes the place of scaled conjugate gradients.
    """

    n_rounds: int
    n_steps: int

    def learn(self, posterior: Posterior, start: Estimate, rng: np.random.Generator) -> Estimate:
        """Return the estimate after all rounds."""
        del rng
        at = start
        for _ in range(self.n_rounds):
            at = self._round(posterior, with_best_scales(posterior, at))
        return at

    def _round(self, posterior: Posterior, at: Estimate) -> Estimate:
        def objective(x: Array, alpha: Array, beta: Array) -> tuple[float, Sequence[Array]]:
            found = posterior.slopes(Estimate(x, alpha, beta, at.scales))
            return found.value, (found.x, found.alpha, found.beta)

        x, alpha, beta = descend(objective, (at.x, at.alpha, at.beta), self.n_steps)
        return Estimate(x, alpha, beta, at.scales)


@dataclass(frozen=True)
class Balanced(MaximumAPosteriori):
    """§4.2: the prior of the trajectories weighs as much as the poses, by D/d."""

    def weight(self, n_channels: int, n_latent: int) -> float:
        """Return D/d."""
        return n_channels / n_latent


@dataclass(frozen=True)
class FixedDynamics(MaximumAPosteriori):
    """§4.3: the parameters of the dynamics are stated by hand, and the rest is learnt.

    Parameters
    ----------
    alpha : tuple of float
    """

    alpha: tuple[float, ...]

    def learn(self, posterior: Posterior, start: Estimate, rng: np.random.Generator) -> Estimate:
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

    def _round(self, posterior: Posterior, at: Estimate) -> Estimate:
        def objective(x: Array, beta: Array) -> tuple[float, Sequence[Array]]:
            found = posterior.slopes(Estimate(x, at.alpha, beta, at.scales))
            return found.value, (found.x, found.beta)

        x, beta = descend(objective, (at.x, at.beta), self.n_steps)
        return Estimate(x, at.alpha, beta, at.scales)
