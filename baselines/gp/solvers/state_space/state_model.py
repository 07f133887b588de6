r"""A block as a state-space model: one Markov chain for each component and draw of a layer.

Chain j holds the state of its kernel once per output, with stationary covariance
:math:`I \otimes B_j` (docs/mathematics/solvers.md, section 6). The coregionalisation matrices are
used as they are and never inverted, so they may be singular. The states of all chains form one
column of length s = J m D with axes (chain, coordinate, output). An observation is a weighted sum
of the chains' first coordinates. The model's matrices are applied without forming them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.markov import state_order, steps
from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.basics.arrays import Array

__all__ = ["StateModel"]


@dataclass(frozen=True, eq=False)
class StateModel:
    """J independent chains in time, and how the units of a block observe them.

    Parameters
    ----------
    kernel : StationaryKernel
        A half-integer Matérn kernel, of state order m.
    layers : mapping of str to LayerParameters
        The layers of the block. Chains are ordered by layer, then component, then draw.
    n_draws : mapping of str to int
        The number of draws of each layer.
    units : ndarray of shape (P, J)
        The loading of each unit on each chain.
    """

    kernel: StationaryKernel
    layers: Mapping[str, LayerParameters]
    n_draws: Mapping[str, int]
    units: Array

    @classmethod
    def of(cls, kernel: StationaryKernel, block: Block, parameters: Parameters) -> StateModel:
        """Build the model of ``block``."""
        layers = {name: parameters.layers[name] for name in block.units}
        n_draws = {name: factor.shape[1] for name, factor in block.units.items()}
        units = [np.tile(block.units[name], layers[name].lengthscales.size) for name in layers]
        return cls(kernel, layers, n_draws, np.concatenate(units, axis=1))

    @cached_property
    def lengthscales(self) -> Array:
        """(J,) lengthscales."""
        return np.concatenate(
            [
                np.repeat(layer.lengthscales, self.n_draws[name])
                for name, layer in self.layers.items()
            ]
        )

    @cached_property
    def matrices(self) -> Array:
        """(J, D, D) the matrices B_j."""
        return np.concatenate(
            [
                np.repeat(layer.matrices, self.n_draws[name], axis=0)
                for name, layer in self.layers.items()
            ]
        )

    @property
    def shape(self) -> tuple[int, int, int]:
        """The axes (J, m, D) of a state."""
        n_chains, n_outputs, _ = self.matrices.shape
        return n_chains, state_order(self.kernel), n_outputs

    @property
    def size(self) -> int:
        """The length s of a state."""
        return int(np.prod(self.shape))

    def steps(self, lags: Array) -> Array:
        """Return Φ, Q and their derivatives for every chain over lags (T,), (4, T, J, m, m)."""
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

    def coefficients(self, target: Target) -> Array:
        """Return the loadings of ``target`` on the chains, (J,)."""
        return np.concatenate(
            [
                np.tile(target.weights[name], layer.lengthscales.size)
                for name, layer in self.layers.items()
            ]
        )

    def pull_back(self, log_lengthscales: Array, matrices: Array) -> dict[str, LayerParameters]:
        """Return the layers' gradients from those in log ℓ_j, (J,), and in B_j, (J, D, D)."""
        gradients, start = {}, 0
        for name, layer in self.layers.items():
            by_draw = (layer.lengthscales.size, self.n_draws[name])
            chains = slice(start, start + by_draw[0] * by_draw[1])
            by_matrix = matrices[chains].reshape(*by_draw, *matrices.shape[1:]).sum(axis=1)
            by_scale = log_lengthscales[chains].reshape(by_draw).sum(axis=1)
            gradients[name] = layer.pull_back(by_scale, by_matrix)
            start = chains.stop
        return gradients
