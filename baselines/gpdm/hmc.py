"""Hybrid Monte Carlo whose step size adapts while samples are discarded (GPDM §4.4).

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mocapbench.basics.arrays import Array

__all__ = ["HybridMonteCarlo"]

Potential = Callable[[Array], tuple[float, Array]]

# At equilibrium p ln 1.1 = (1 − p) ln(1/0.8): an acceptance rate p of 0.70, where the paper asks
# for 0.6 to 0.95.
_LONGER, _SHORTER = 1.1, 0.8


@dataclass(frozen=True)
class HybridMonteCarlo:
    """A sampler of the density proportional to exp(−potential).

    Parameters
    ----------
    n_samples, n_burn : int
        Number of states returned, and number discarded before them. While they are discarded, the
        step size grows by a tenth after each trajectory that is accepted and shrinks by a fifth
        after each that is rejected. Then it stays at its geometric mean over the last half of them:
        a step that followed the states that are kept would draw these to where long steps are
        accepted.
    n_leaps : int
        Leapfrog steps of a trajectory.
    step : float
        Initial step size.

    References
    ----------
    GPDM, footnote 9; D. J. C. MacKay (2003), Information Theory, Inference, and Learning
    Algorithms, §30.1.
    """

    n_samples: int
    n_burn: int
    n_leaps: int
    step: float

    def sample(
        self, potential: Potential, start: Array, rng: np.random.Generator
    ) -> tuple[Array, float]:
        """Return states (n_samples, *start.shape) and the fraction of trajectories accepted."""
        state, here, steps, kept, n_accepted = start, potential(start), [self.step], [], 0
        for _ in range(self.n_burn):
            state, here, accepted = self._trajectory(potential, state, here, steps[-1], rng)
            n_accepted += accepted
            steps.append(steps[-1] * (_LONGER if accepted else _SHORTER))
        step = float(np.exp(np.log(steps[len(steps) // 2 :]).mean()))
        for _ in range(self.n_samples):
            state, here, accepted = self._trajectory(potential, state, here, step, rng)
            n_accepted += accepted
            kept.append(state)
        return np.stack(kept), n_accepted / (self.n_burn + self.n_samples)

    def _trajectory(
        self,
        potential: Potential,
        state: Array,
        here: tuple[float, Array],
        step: float,
        rng: np.random.Generator,
    ) -> tuple[Array, tuple[float, Array], bool]:
        """Return the next state, its potential and gradient, and whether it was accepted.

        A trajectory on which a factorisation fails or a number overflows is rejected.
        """
        momentum = rng.standard_normal(state.shape)
        energy = here[0] + 0.5 * float((momentum**2).sum())
        threshold = rng.random()
        try:
            with np.errstate(over="ignore", invalid="ignore"):
                there, momentum, end = self._leap(potential, state, momentum, here, step)
                change = energy - end[0] - 0.5 * float((momentum**2).sum())
        except np.linalg.LinAlgError:
            return state, here, False
        # Metropolis: with probability exp(−change of energy), at most 1.
        if np.isfinite(change) and np.log(threshold) < change:
            return there, end, True
        return state, here, False

    def _leap(
        self,
        potential: Potential,
        state: Array,
        momentum: Array,
        here: tuple[float, Array],
        step: float,
    ) -> tuple[Array, Array, tuple[float, Array]]:
        """Return the state, the momentum and the potential after ``n_leaps`` leapfrog steps."""
        # Half a step of the momentum, a step of the state, half a step of the momentum.
        for _ in range(self.n_leaps):
            momentum = momentum - 0.5 * step * here[1]
            state = state + step * momentum
            here = potential(state)
            momentum = momentum - 0.5 * step * here[1]
        return state, momentum, here
