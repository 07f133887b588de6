"""The matrices of a block's state-space model, applied without forming them.

A state is a column of length s = J m D with axes (chain, coordinate, output). An observation is a
weighted sum of the chains' first coordinates (docs/mathematics/solvers.md, section 6).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.markov import Steps, state_order, steps
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.block import Block
from mocapbench.baselines.gp.solvers.state_space.chains import Chains
from mocapbench.basics.arrays import Array

__all__ = ["StateModel"]


@dataclass(frozen=True, eq=False)
class StateModel:
    """Chains in time.

    Parameters
    ----------
    kernel : StationaryKernel
        A half-integer Matérn kernel, of state order m.
    chains : Chains
        The J chains.
    lengthscales : ndarray of shape (J,)
        Their lengthscales.
    matrices : ndarray of shape (J, D, D)
        Their coregionalisation matrices B_j.
    """

    kernel: StationaryKernel
    chains: Chains
    lengthscales: Array
    matrices: Array

    @classmethod
    def of(cls, kernel: StationaryKernel, block: Block, parameters: Parameters) -> StateModel:
        """Build the model of ``block``."""
        chains = Chains.of(block, parameters)
        return cls(kernel, chains, chains.lengthscales, chains.matrices)

    @property
    def units(self) -> Array:
        """(P, J) loadings of the units on the chains."""
        return self.chains.units

    @property
    def shape(self) -> tuple[int, int, int]:
        """The axes (J, m, D) of a state."""
        n_chains, n_outputs, _ = self.matrices.shape
        return n_chains, state_order(self.kernel), n_outputs

    @property
    def size(self) -> int:
        """The length s of a state."""
        return int(np.prod(self.shape))

    def steps(self, lags: Array) -> Steps:
        """Return Φ and Q of every chain over lags (T,)."""
        return steps(self.kernel, lags, self.lengthscales)

    def propagate(self, transition: Array, states: Array) -> Array:
        """Return Φ x for states (s, k); ``transition`` is (J, m, m)."""
        by_chain = states.reshape(*self.shape[:2], -1)
        return np.asarray((transition @ by_chain).reshape(states.shape))

    def predict_covariance(self, transition: Array, noise: Array, covariance: Array) -> Array:
        """Return Φ P Φᵀ + Q ⊗ B for a covariance P (s, s)."""
        predicted = self.propagate(transition, self.propagate(transition, covariance).T)
        chain = np.arange(len(noise))
        predicted.reshape(*self.shape, *self.shape)[chain, :, :, chain] += (
            noise[:, :, None, :, None] * self.matrices[:, None, :, None, :]
        )
        return predicted

    def observe(self, loadings: Array, states: Array) -> Array:
        """Return H x for states (s, k), (L D, k), with loadings (L, J) on the chains."""
        first = states.reshape(*self.shape, -1)[:, 0]
        observed = np.tensordot(loadings, first, axes=1)
        return np.asarray(observed.reshape(-1, states.shape[1]))

    def observe_adjoint(self, loadings: Array, entries: Array) -> Array:
        """Return Hᵀ y for entries (L D, k), (s, k): the adjoint of `observe`."""
        states = np.zeros((*self.shape, entries.shape[1]))
        by_row = entries.reshape(len(loadings), -1, entries.shape[1])
        states[:, 0] = np.tensordot(loadings.T, by_row, axes=1)
        return states.reshape(-1, entries.shape[1])
