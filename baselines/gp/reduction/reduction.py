r"""A likelihood as a sum over block problems (docs/mathematics/inference.md, section 2).

In each reduction the log-likelihood of the replicates is exactly the sum of the log-densities of a
few `Block` problems and of a closed form. The posterior of a replicate's curve is a sum of
independent terms (`Target`), each given by one block. `one_layer` and `hierarchy` make the
reductions of the models.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.reduction.tree import Node
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.baselines.gp.solvers.solver import Solver
from mocapbench.basics.arrays import Array

__all__ = ["Reduction"]


@dataclass(frozen=True, eq=False)
class Reduction:
    """A likelihood as a sum over blocks.

    Parameters
    ----------
    blocks : tuple of Block
        The block problems.
    replicates : tuple of tuple of Target
        For each replicate, the terms of its noise-free curve.
    trend : tuple of Target
        The terms of the curve around which new replicates lie; empty if that is zero.
    constant : float
        The part of the log-likelihood that does not depend on the parameters.
    within_dof, within_scatter : ndarray of shape (D,)
        m_d and S_d of the term −½ m_d log 2πβ_d − S_d / 2β_d, which depends on the noise only.
    nodes : mapping of tuple of str to tuple of Target
        The terms of the curve of each node of a tree, where there is one.
    """

    blocks: tuple[Block, ...]
    replicates: tuple[tuple[Target, ...], ...]
    trend: tuple[Target, ...]
    constant: float
    within_dof: Array
    within_scatter: Array
    nodes: Mapping[Node, tuple[Target, ...]] = field(default_factory=dict)

    def evaluate(self, solvers: Sequence[Solver], parameters: Parameters) -> tuple[float, Array]:
        """Return the log-likelihood and its gradient in the free coordinates (n_parameters,).

        Parameters
        ----------
        solvers : sequence of Solver
            One for each block.
        parameters : Parameters
            The parameters at which to evaluate.

        Raises
        ------
        SingularCovarianceError
            If the covariance of a block is not numerically positive definite.
        """
        value, gradient = self._within(parameters)
        for block, solver in zip(self.blocks, solvers, strict=True):
            block_value, block_gradient = solver.evaluate(block, parameters)
            value += block_value
            gradient += block_gradient.flat
        return value, gradient

    @property
    def within_variance(self) -> Array:
        """(D,) S_d / m_d, the noise variance that maximises the within term alone, or 0."""
        return self.within_scatter / np.maximum(self.within_dof, 1.0)

    def _within(self, parameters: Parameters) -> tuple[float, Array]:
        """Return the constant plus the term of m_d and S_d, and its gradient."""
        dof, scatter, noise = self.within_dof, self.within_scatter, parameters.noise
        value = self.constant - 0.5 * float(
            dof @ np.log(2.0 * np.pi * noise) + (scatter / noise).sum()
        )
        by_output = 0.5 * (scatter / noise - dof)
        layers = {name: layer.zeros() for name, layer in parameters.layers.items()}
        return value, Parameters(layers, by_output).flat
