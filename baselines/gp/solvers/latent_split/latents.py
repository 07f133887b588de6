"""The latent functions of what outputs share in a block (docs/mathematics/solvers.md, section 5).

Every column of a factor W_q has one latent function for each independent draw of its layer. The
column holds the loadings of the outputs on these functions, the draw those of the units.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.prior.pivoted import PivotedRoot
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.basics.arrays import Array

__all__ = ["Latent", "Latents"]

Column = tuple[str, int, int]
"""A column of a coregionalisation factor: layer, component q, index within W_q."""


@dataclass(frozen=True, eq=False)
class Latent:
    """One latent function v = Λ u, with white u.

    Parameters
    ----------
    column : int
        Index of its column.
    draw : int
        Index of its draw of the layer.
    units : ndarray of shape (P,)
        c, the loadings of the units on it.
    seen : ndarray of int
        Indices of the times at which a unit that loads on it has a visible entry.
    root : PivotedRoot
        Λ as a function of time, factorised at those times.
    white : slice
        The slice of its coordinates u among those of all latent functions.
    values : ndarray of shape (N, rank)
        Λ at the block's times, with rows of zeros at times not in ``seen``.
    """

    column: int
    draw: int
    units: Array
    seen: NDArray[np.intp]
    root: PivotedRoot
    white: slice
    values: Array


@dataclass(frozen=True, eq=False)
class Latents:
    """All latent functions of a block.

    Parameters
    ----------
    columns : tuple of Column
        Names of the n columns.
    weights : ndarray of shape (n, D)
        w, the loadings of the outputs on the functions of each column.
    functions : tuple of Latent
        The latent functions, by column.
    """

    columns: tuple[Column, ...]
    weights: Array
    functions: tuple[Latent, ...]

    @classmethod
    def of(cls, kernel: StationaryKernel, block: Block, parameters: Parameters) -> Latents:
        """List the latent functions of ``block``."""
        columns = tuple(_columns(block, parameters))
        weights = np.zeros((len(columns), block.observed.shape[1]))
        for row, (name, q, number) in zip(weights, columns, strict=True):
            row[:] = parameters.layers[name].weights[q, :, number]
        return cls(columns, weights, tuple(_functions(kernel, block, parameters, columns)))

    @property
    def n_white(self) -> int:
        """K, the number of white coordinates."""
        return self.functions[-1].white.stop if self.functions else 0

    @cached_property
    def by_column(self) -> tuple[tuple[int, ...], ...]:
        """For each column, the indices of its functions."""
        return tuple(
            tuple(i for i, latent in enumerate(self.functions) if latent.column == a)
            for a in range(len(self.columns))
        )

    @cached_property
    def pairs(self) -> tuple[tuple[int, int], ...]:
        """The pairs a ≤ b of columns."""
        n = len(self.columns)
        return tuple((a, b) for a in range(n) for b in range(a, n))

    @cached_property
    def products(self) -> Array:
        """(n_pairs, D), the products w_a w_b."""
        products = [self.weights[a] * self.weights[b] for a, b in self.pairs]
        return np.reshape(products, (-1, self.weights.shape[1]))

    def at(self, times: Array) -> Array:
        """Return (M, K), all Λ at other times, side by side."""
        roots = [latent.root.at(times) for latent in self.functions]
        return np.hstack([np.empty((len(times), 0)), *roots])

    def coefficients(self, target: Target) -> Array:
        """Return the loadings of the target's outputs on each coordinate's function, (K, D)."""
        loadings = np.empty((self.n_white, self.weights.shape[1]))
        for latent in self.functions:
            name, _, _ = self.columns[latent.column]
            of_draw = target.weights[name][latent.draw]
            loadings[latent.white] = of_draw * self.weights[latent.column]
        return loadings


def _columns(block: Block, parameters: Parameters) -> Iterator[Column]:
    for name in block.units:
        n_components, _, rank = parameters.layers[name].weights.shape
        for q, number in np.ndindex(n_components, rank):
            yield name, q, number


def _functions(
    kernel: StationaryKernel, block: Block, parameters: Parameters, columns: tuple[Column, ...]
) -> Iterator[Latent]:
    roots: dict[tuple[float, bytes], PivotedRoot] = {}
    start = 0
    for a, (name, q, _) in enumerate(columns):
        scale = float(parameters.layers[name].lengthscales[q])
        for draw, units in enumerate(block.units[name].T):
            seen = np.flatnonzero(block.observed[units != 0.0].any(axis=(0, 1)))
            key = (scale, seen.tobytes())
            if key not in roots:
                roots[key] = PivotedRoot.of(kernel, scale, block.times[seen])
            root = roots[key]
            values = np.zeros((len(block.times), root.values.shape[1]))
            values[seen] = root.values
            white = slice(start, start + values.shape[1])
            start = white.stop
            yield Latent(a, draw, units, seen, root, white, values)
