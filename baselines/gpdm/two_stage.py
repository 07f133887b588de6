"""Two-stage learning (GPDM §4.4): parameters by Monte Carlo EM, then positions given them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gpdm.descent import descend
from mocapbench.baselines.gpdm.hmc import HybridMonteCarlo
from mocapbench.baselines.gpdm.learning import Learning
from mocapbench.baselines.gpdm.posterior import Estimate, Posterior

__all__ = ["TwoStage"]

Array = NDArray[np.float64]

_TO_MODE = 100
"""Steps to a mode of the positions, from which each chain starts (footnote 9)."""


@dataclass(frozen=True)
class TwoStage(Learning):
    """Algorithm 2, then steps in the positions from the last sample.

    The posterior over the positions is sampled given the parameters; the parameters minimise the
    mean of the negative log-posterior over the samples.

    Parameters
    ----------
    sampler : HybridMonteCarlo
        The paper draws R = 50 samples after 10, with 100 leapfrog steps each.
    n_rounds, n_turns, n_steps : int
        The paper's I, J and K: rounds of EM, and in each M-step turns between the scales in
        closed form and steps in the other parameters.
    n_last : int
        Steps of the second stage.
    """

    sampler: HybridMonteCarlo
    n_rounds: int
    n_turns: int
    n_steps: int
    n_last: int

    def learn(self, posterior: Posterior, start: Estimate, rng: np.random.Generator) -> Estimate:
        """Return the estimate after both stages."""
        at = replace(start, scales=posterior.best_scales(posterior.inverse(start.x, start.beta)))
        for _ in range(self.n_rounds):
            samples = self._samples(posterior, at, rng)
            at = self._maximised(posterior, samples, replace(at, x=samples[-1]))
        return settled(posterior, at, self.n_last)

    def _samples(self, posterior: Posterior, at: Estimate, rng: np.random.Generator) -> Array:
        def potential(x: Array) -> tuple[float, Array]:
            found = posterior.slopes(replace(at, x=x))
            return found.value, found.x

        mode = settled(posterior, at, _TO_MODE)
        samples, _ = self.sampler.sample(potential, mode.x, rng)
        return samples

    def _maximised(self, posterior: Posterior, samples: Array, at: Estimate) -> Estimate:
        """Return the parameters of the M-step."""

        def objective(alpha: Array, beta: Array) -> tuple[float, Sequence[Array]]:
            found = [posterior.slopes(Estimate(x, alpha, beta, at.scales)) for x in samples]
            value = float(np.mean([each.value for each in found]))
            slopes = [[each.alpha, each.beta] for each in found]
            return value, [np.mean(column, axis=0) for column in zip(*slopes, strict=True)]

        for _ in range(self.n_turns):
            inverse = np.mean([posterior.inverse(x, at.beta) for x in samples], axis=0)
            at = replace(at, scales=posterior.best_scales(inverse))
            alpha, beta = descend(objective, (at.alpha, at.beta), self.n_steps)
            at = replace(at, alpha=alpha, beta=beta)
        return at


def settled(posterior: Posterior, at: Estimate, n_steps: int) -> Estimate:
    """Return the estimate after ``n_steps`` in the positions alone."""

    def objective(x: Array) -> tuple[float, Sequence[Array]]:
        found = posterior.slopes(replace(at, x=x))
        return found.value, (found.x,)

    (x,) = descend(objective, (at.x,), n_steps)
    return replace(at, x=x)
