r"""From replicates to block problems, exactly; `hierarchy` does it for more than one layer.

In each reduction the log-likelihood is the sum of the log-densities of a few `Block` problems and
of a closed form, and what is to be inferred about a replicate is a sum of independent `Share`\ s,
one from each block that knows about it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.prior.parameters import CHILD, PARENT, Parameters
from mocapbench.baselines.gp.reduction.replicates import Pattern, Replicates
from mocapbench.baselines.gp.reduction.tree import Node
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.baselines.gp.solvers.solver import Solver

__all__ = ["Reduction", "Share", "independent", "pooled"]

Array = NDArray[np.float64]

_ONE = np.ones((1, 1))


@dataclass(frozen=True, eq=False)
class Share:
    """One independent part of a function to be inferred.

    Parameters
    ----------
    block : int
        Index of the block that knows about it.
    column : int
        Index of the data vector that it is conditioned on.
    target : Target
        The function in terms of the block's layers.
    """

    block: int
    column: int
    target: Target


@dataclass(frozen=True, eq=False)
class Reduction:
    """A likelihood as a sum over blocks.

    Parameters
    ----------
    blocks : tuple of Block
        The block problems.
    replicates : tuple of tuple of Share
        For each replicate the shares of its noise-free curve.
    trend : tuple of Share
        The shares of the curve around which new replicates lie.
    constant : float
        What does not depend on the parameters.
    within_dof, within_scatter : ndarray of shape (D,)
        m_d and S_d of the term −½ m_d log 2πβ_d − S_d / 2β_d that sees the noise alone.
    nodes : mapping of tuple of str to tuple of Share
        The shares of the curve of each node of a tree, where there is one.
    """

    blocks: tuple[Block, ...]
    replicates: tuple[tuple[Share, ...], ...]
    trend: tuple[Share, ...]
    constant: float
    within_dof: Array
    within_scatter: Array
    nodes: Mapping[Node, tuple[Share, ...]] = field(default_factory=dict)

    def evaluate(self, solvers: Sequence[Solver], parameters: Parameters) -> tuple[float, Array]:
        """Return the log-likelihood and its gradient in the free coordinates (n_parameters,).

        There is one solver for each block.
        """
        value, gradient = self._within(parameters)
        for block, solver in zip(self.blocks, solvers, strict=True):
            block_value, block_gradient = solver.evaluate(block, parameters)
            value += block_value
            gradient += block_gradient.flat
        return value, gradient

    @property
    def within_variance(self) -> Array:
        """(D,) S_d / m_d, the noise variance that the within term alone would choose, or 0."""
        return self.within_scatter / np.maximum(self.within_dof, 1.0)

    def _within(self, parameters: Parameters) -> tuple[float, Array]:
        dof, scatter, noise = self.within_dof, self.within_scatter, parameters.noise
        value = self.constant - 0.5 * float(
            dof @ np.log(2.0 * np.pi * noise) + (scatter / noise).sum()
        )
        by_output = 0.5 * (scatter / noise - dof)
        layers = {name: layer.zeros() for name, layer in parameters.layers.items()}
        return value, Parameters(layers, by_output).flat


def pooled(replicates: Replicates) -> Reduction:
    """Reduce replicates that are noisy observations of one and the same function g.

    The n_dt values of an entry are replaced by their mean, with noise β_d / n_dt; their scatter
    around it sees the noise alone.
    """
    counts = replicates.observed.sum(axis=0)
    observed = counts > 0
    safe = np.maximum(counts, 1)
    mean = replicates.data.sum(axis=0) / safe
    scatter = np.where(replicates.observed, replicates.data - mean, 0.0) ** 2
    block = Block(
        times=replicates.times,
        units={PARENT: _ONE},
        observed=observed[None],
        data=mean[None, None],
        noise_scale=(1.0 / safe)[None],
        multiplicity=1,
    )
    trend = (Share(0, 0, Target({PARENT: np.ones(1)}, {})),)
    return Reduction(
        blocks=(block,),
        replicates=(trend,) * len(replicates.data),
        trend=trend,
        constant=-0.5 * float(np.log(safe).sum()),
        within_dof=(safe - 1.0).sum(axis=1),
        within_scatter=scatter.sum(axis=(0, 2)),
    )


def independent(replicates: Replicates) -> Reduction:
    """Reduce replicates that are independent draws of one process, f_r ~ GP(0, K_f)."""
    nothing = np.zeros(replicates.data.shape[1])
    unseen = Target({CHILD: np.zeros(1)}, {CHILD: 1.0})
    shares = [(Share(0, 0, unseen),)] * len(replicates.data)
    for index, pattern in enumerate(replicates.patterns):
        for column, r in enumerate(pattern.members):
            shares[r] = (Share(index, column, _child()),)
    return Reduction(
        blocks=tuple(_draws(replicates, pattern) for pattern in replicates.patterns),
        replicates=tuple(shares),
        trend=(),
        constant=0.0,
        within_dof=nothing,
        within_scatter=nothing,
    )


def _child() -> Target:
    return Target({CHILD: np.ones(1)}, {})


def _draws(replicates: Replicates, pattern: Pattern) -> Block:
    return Block(
        times=replicates.times,
        units={CHILD: _ONE},
        observed=pattern.observed[None],
        data=replicates.data[pattern.members][:, None],
        noise_scale=np.ones((1, *pattern.observed.shape)),
        multiplicity=pattern.size,
    ).trimmed()
