r"""The state of a block: one Markov chain for each component and draw of a layer.

Chain j holds the state of its kernel once per output, with stationary covariance
:math:`I \otimes B_j` (docs/mathematics/solvers.md, section 6). The coregionalisation matrices are
used as they are and never inverted, so they may be singular. The states of all chains form one
vector of length s = J m D with axes (chain, coordinate, output).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.basics.arrays import Array

__all__ = ["Chains"]


@dataclass(frozen=True, eq=False)
class Chains:
    """J independent chains, and how the units of a block observe them.

    Parameters
    ----------
    layers : mapping of str to LayerParameters
        The layers of the block. Chains are ordered by layer, then component, then draw.
    n_draws : mapping of str to int
        The number of draws of each layer.
    units : ndarray of shape (P, J)
        The loading of each unit on each chain.
    """

    layers: Mapping[str, LayerParameters]
    n_draws: Mapping[str, int]
    units: Array

    @classmethod
    def of(cls, block: Block, parameters: Parameters) -> Chains:
        """List the chains of ``block``."""
        layers = {name: parameters.layers[name] for name in block.units}
        n_draws = {name: factor.shape[1] for name, factor in block.units.items()}
        units = [np.tile(block.units[name], layers[name].lengthscales.size) for name in layers]
        return cls(layers, n_draws, np.concatenate(units, axis=1))

    @property
    def lengthscales(self) -> Array:
        """(J,) lengthscales."""
        return np.concatenate(
            [
                np.repeat(layer.lengthscales, self.n_draws[name])
                for name, layer in self.layers.items()
            ]
        )

    @property
    def matrices(self) -> Array:
        """(J, D, D) the matrices B_j."""
        return np.concatenate(
            [
                np.repeat(layer.coregionalisation.matrices, self.n_draws[name], axis=0)
                for name, layer in self.layers.items()
            ]
        )

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
            gradients[name] = LayerParameters(
                log_lengthscales[chains].reshape(by_draw).sum(axis=1),
                layer.coregionalisation.pull_back(by_matrix),
            )
            start = chains.stop
        return gradients
