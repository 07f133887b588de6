r"""From replicates to a likelihood as a sum over block problems, exactly.

Replicates are recordings on one time grid. In each reduction their log-likelihood is exactly the
sum of the log-densities of a few `Block` problems and of a closed form. The posterior of a
replicate's curve is a sum of independent terms (`Target`), each given by one block. Here are the
reductions of models with one layer; `hierarchy` has those of trees.

A *pattern* is a set of replicates with the same visible entries. Exact inference needs only the
mean curve of a pattern and the deviations from it, so its cost hardly grows with the number of
replicates (docs/mathematics/inference.md, section 2).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.prior.parameters import CHILD, PARENT, Parameters
from mocapbench.baselines.gp.reduction.tree import Node
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.baselines.gp.solvers.solver import Solver
from mocapbench.basics.arrays import Array, Index
from mocapbench.datasets import Recording

__all__ = ["Reduction", "Replicates", "pool_replicates", "separate_replicates"]


@dataclass(frozen=True, eq=False)
class Replicates:
    """R replicates of D outputs on the union of their visible times.

    Parameters
    ----------
    times : ndarray of shape (N,)
        All times at which something is visible.
    data : ndarray of shape (R, D, N)
        The values, 0 where hidden.
    observed : ndarray of bool, shape (R, D, N)
        Which entries are visible.
    """

    times: Array
    data: Array
    observed: NDArray[np.bool_]

    @classmethod
    def align(cls, recordings: Sequence[Recording]) -> Self:
        """Put recordings with the same channels on the union of their visible times."""
        seen = [recording.visible.any(axis=1) for recording in recordings]
        times = np.unique(
            np.concatenate([rec.times[rows] for rec, rows in zip(recordings, seen, strict=True)])
        )
        values = np.full((len(recordings), len(recordings[0].channels), len(times)), np.nan)
        for replicate, recording, rows in zip(values, recordings, seen, strict=True):
            columns = np.searchsorted(times, recording.times[rows])
            replicate[:, columns] = recording.values[rows].T
        observed = ~np.isnan(values)
        return cls(times, np.where(observed, values, 0.0), observed)

    def showing(self, number: int, recording: Recording) -> Self:
        """Return the replicates where one of them shows no more than a recording does.

        Parameters
        ----------
        number : int
            That of the replicate.
        recording : Recording
            With the same channels; visible where the replicate is, or at fewer entries.
        """
        rows = recording.visible.any(axis=1)
        shown = np.zeros_like(self.observed[number])
        shown[:, np.searchsorted(self.times, recording.times[rows])] = recording.visible[rows].T
        observed = self.observed.copy()
        observed[number] = shown
        return replace(self, data=np.where(observed, self.data, 0.0), observed=observed)

    @cached_property
    def patterns(self) -> tuple[tuple[Index, NDArray[np.bool_]], ...]:
        """The patterns, in order of first appearance, of replicates with a visible entry.

        Each is the indices (R_p,) of its replicates, and which of their entries (D, N) are visible.
        """
        groups: dict[bytes, list[int]] = {}
        for r, visible in enumerate(self.observed):
            groups.setdefault(visible.tobytes(), []).append(r)
        return tuple(
            (np.array(members), self.observed[members[0]])
            for members in groups.values()
            if self.observed[members[0]].any()
        )


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


def pool_replicates(replicates: Replicates) -> Reduction:
    """Reduce replicates that are noisy observations of one and the same function g.

    The n_dt values of an entry are replaced by their mean, with noise variance β_d / n_dt. Their
    scatter around the mean depends on the noise only.
    """
    # n_dt, the means and the squares of the deviations from them.
    counts = replicates.observed.sum(axis=0)
    observed = counts > 0
    safe = np.maximum(counts, 1)
    mean = replicates.data.sum(axis=0) / safe
    scatter = np.where(replicates.observed, replicates.data - mean, 0.0) ** 2
    block = Block(
        times=replicates.times,
        units={PARENT: np.ones((1, 1))},
        observed=observed[None],
        data=mean[None, None],
        noise_scale=(1.0 / safe)[None],
        multiplicity=1,
    )
    trend = (Target({PARENT: np.ones(1)}),)
    return Reduction(
        blocks=(block,),
        replicates=(trend,) * len(replicates.data),
        trend=trend,
        constant=-0.5 * float(np.log(safe).sum()),
        within_dof=(safe - 1.0).sum(axis=1),
        within_scatter=scatter.sum(axis=(0, 2)),
    )


def separate_replicates(replicates: Replicates) -> Reduction:
    """Reduce replicates that are independent draws of one process, f_r ~ GP(0, K_f).

    There is one block for each pattern of visible entries, with the pattern's members as its data
    vectors.
    """
    zeros = np.zeros(replicates.data.shape[1])
    # A replicate of which nothing is visible has its prior.
    prior = Target({CHILD: np.zeros(1)}, {CHILD: 1.0})
    terms = [(prior,)] * len(replicates.data)
    for block, (members, _) in enumerate(replicates.patterns):
        for column, r in enumerate(members):
            terms[r] = (Target({CHILD: np.ones(1)}, block=block, column=column),)
    return Reduction(
        blocks=tuple(_block(replicates, *pattern) for pattern in replicates.patterns),
        replicates=tuple(terms),
        trend=(),
        constant=0.0,
        within_dof=zeros,
        within_scatter=zeros,
    )


def _block(replicates: Replicates, members: Index, observed: NDArray[np.bool_]) -> Block:
    """Return the problem of the members of a pattern."""
    return Block(
        times=replicates.times,
        units={CHILD: np.ones((1, 1))},
        observed=observed[None],
        data=replicates.data[members][:, None],
        noise_scale=np.ones((1, *observed.shape)),
        multiplicity=len(members),
    ).trim()
