"""Two-stage learning (GPDM §4.4): parameters by Monte Carlo EM, then positions given them.

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mocapbench.baselines.gpdm.descent import descend
from mocapbench.baselines.gpdm.hmc import HybridMonteCarlo
from mocapbench.baselines.gpdm.learning import Learning
from mocapbench.baselines.gpdm.posterior import JointPosterior, PointEstimate
from mocapbench.basics.arrays import Array

__all__ = ["TwoStage"]


_TO_MODE = 100
"""Iterations of L-BFGS towards a mode, where each chain starts (GPDM footnote 9)."""


@dataclass(frozen=True)
class TwoStage(Learning):
    """GPDM Algorithm 2, and then L-BFGS on the positions from the last sample.

    The E-step samples the posterior of the positions given the parameters. The M-step minimises
    the negative log-posterior, averaged over the samples, with respect to the parameters.

    Parameters
    ----------
    sampler : HybridMonteCarlo
        The paper draws R = 50 samples after 10 discarded ones, with 100 leapfrog steps each.
    n_rounds, n_alternations, n_steps : int
        The paper's I, J and K: rounds of EM; within an M-step, alternations between the scales in
        closed form and the other parameters; and iterations of L-BFGS on the latter.
    n_last : int
        Iterations of L-BFGS in the second stage.
    """

    sampler: HybridMonteCarlo
    n_rounds: int
    n_alternations: int
    n_steps: int
    n_last: int

    def learn(
        self, posterior: JointPosterior, start: PointEstimate, rng: np.random.Generator
    ) -> PointEstimate:
        """Return the estimate after both stages."""
        estimate = replace(
            start, scales=posterior.best_scales(posterior.inverse(start.x, start.beta))
        )
        for _ in range(self.n_rounds):
            samples = self._samples(posterior, estimate, rng)
            estimate = self._maximise_parameters(
                posterior, samples, replace(estimate, x=samples[-1])
            )
        return optimise_latents(posterior, estimate, self.n_last)

    def _samples(
        self, posterior: JointPosterior, estimate: PointEstimate, rng: np.random.Generator
    ) -> Array:
        def potential(x: Array) -> tuple[float, Array]:
            value, (d_x, _, _) = posterior.value_and_gradients(replace(estimate, x=x))
            return value, d_x

        mode = optimise_latents(posterior, estimate, _TO_MODE)
        samples, _ = self.sampler.sample(potential, mode.x, rng)
        return samples

    def _maximise_parameters(
        self, posterior: JointPosterior, samples: Array, estimate: PointEstimate
    ) -> PointEstimate:
        """Return the estimate with the parameters of the M-step."""

        def objective(alpha: Array, beta: Array) -> tuple[float, Sequence[Array]]:
            points = [PointEstimate(x, alpha, beta, estimate.scales) for x in samples]
            values, gradients = zip(*map(posterior.value_and_gradients, points), strict=True)
            _, by_alpha, by_beta = zip(*gradients, strict=True)
            return float(np.mean(values)), [np.mean(by_alpha, axis=0), np.mean(by_beta, axis=0)]

        for _ in range(self.n_alternations):
            inverse = np.mean([posterior.inverse(x, estimate.beta) for x in samples], axis=0)
            estimate = replace(estimate, scales=posterior.best_scales(inverse))
            alpha, beta = descend(objective, (estimate.alpha, estimate.beta), self.n_steps)
            estimate = replace(estimate, alpha=alpha, beta=beta)
        return estimate


def optimise_latents(
    posterior: JointPosterior, estimate: PointEstimate, n_steps: int
) -> PointEstimate:
    """Return the estimate after ``n_steps`` iterations of L-BFGS on the positions alone."""

    def objective(x: Array) -> tuple[float, Sequence[Array]]:
        value, (d_x, _, _) = posterior.value_and_gradients(replace(estimate, x=x))
        return value, (d_x,)

    (x,) = descend(objective, (estimate.x,), n_steps)
    return replace(estimate, x=x)
