"""Subtrees of replicates, which grow into each other from the leaves to the root.

A subtree shows a few mean curves, and these are sums of the draws inside it: how is its `Shape`.
Siblings of one shape are replaced by their mean, and the deviations from it put aside.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from mocapbench.baselines.gp.reduction.reduction import Share
from mocapbench.baselines.gp.reduction.tree import Node
from mocapbench.baselines.gp.solvers.block import Block, Target

__all__ = ["Curve", "Deviations", "Shape", "Subtree", "mean_of", "parent_of", "shape_above"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Shape:
    """What subtrees have in common that differ in their draws and noise alone.

    Parameters
    ----------
    number : int
        Its place among the shapes of its level.
    units : mapping of str to ndarray of shape (P, I)
        For each layer, how the P mean curves load on the draws in a subtree.
    observed : ndarray of bool, shape (P, D, N)
        What is visible of them.
    noise : ndarray of shape (P,)
        The factors of their noise variances.
    """

    number: int
    units: Mapping[str, Array]
    observed: NDArray[np.bool_]
    noise: Array

    def block(self, times: Array, data: Array, multiplicity: int) -> Block:
        """Return the problem of data vectors (h, P, D, N)."""
        noise = np.broadcast_to(self.noise[:, None, None], self.observed.shape)
        return Block(times, self.units, self.observed, data, noise, multiplicity).trimmed()

    def of_mean(self, size: int) -> Shape:
        """Return the shape of the mean of so many subtrees, whose draws are their scaled sums."""
        units = {layer: factor * size**-0.5 for layer, factor in self.units.items()}
        return replace(self, units=units, noise=self.noise / size)


@dataclass(frozen=True, eq=False)
class Curve:
    """The curve of a node inside a subtree.

    Parameters
    ----------
    weights : mapping of str to ndarray of shape (I,)
        For each layer, the coefficients of the subtree's draws.
    shares : tuple of Share
        What it has besides in deviations from means.
    """

    weights: Mapping[str, Array]
    shares: tuple[Share, ...]


@dataclass(frozen=True, eq=False)
class Subtree:
    """A node with all that is below it, or the mean of several.

    Parameters
    ----------
    shape : Shape
        What the mean curves are made of.
    data : ndarray of shape (P, D, N)
        The mean curves, 0 where hidden.
    curves : mapping of tuple of str to Curve
        The curves of its nodes.
    """

    shape: Shape
    data: Array
    curves: Mapping[Node, Curve]


class Deviations:
    """Deviations of siblings from their mean, by the shape and the number of the siblings.

    Families that have both in common are data vectors of one block: the covariance between them
    is a projection with a constant diagonal, 1 − 1 / R for families of R siblings.
    """

    def __init__(self) -> None:
        self.families: dict[tuple[Shape, int], list[Array]] = {}

    def add(self, shape: Shape, data: Array) -> tuple[int, int]:
        """Take deviations (R, P, D, N); return their block and the first's data vector.

        Blocks are counted from 1: the means at the root are before them.
        """
        key = (shape, len(data))
        families = self.families.setdefault(key, [])
        families.append(data)
        return 1 + [*self.families].index(key), len(data) * (len(families) - 1)

    def blocks(self, times: Array) -> list[Block]:
        """Return the block of each shape and number."""
        return [
            shape.block(times, np.concatenate(families), len(families) * (size - 1))
            for (shape, size), families in self.families.items()
        ]

    @property
    def log_jacobian(self) -> float:
        """What the log-density gains by taking means: −½ n log R for a family of R siblings."""
        return -0.5 * sum(
            float(len(families) * shape.observed.sum() * np.log(size))
            for (shape, size), families in self.families.items()
        )


def mean_of(siblings: Sequence[Subtree], deviations: Deviations) -> Subtree:
    """Return the mean of siblings of one shape; the deviations from it go to ``deviations``."""
    shape, size = siblings[0].shape, len(siblings)
    if size == 1:
        return siblings[0]
    data = np.stack([sibling.data for sibling in siblings])
    mean = data.mean(axis=0)
    block, first = deviations.add(shape, data - mean)
    curves = {}
    for column, sibling in enumerate(siblings, start=first):
        for node, curve in sibling.curves.items():
            scaled = {layer: weights * size**-0.5 for layer, weights in curve.weights.items()}
            deviation = Share(block, column, Target(curve.weights, {}))
            curves[node] = Curve(scaled, (*curve.shares, deviation))
    return Subtree(shape.of_mean(size), mean, curves)


def shape_above(layer: str, parts: Sequence[Shape], number: int) -> Shape:
    """Return the shape of a node, with a draw of ``layer``, above parts of these shapes."""
    below = {name: block_diag(*(part.units[name] for part in parts)) for name in parts[0].units}
    noise = np.concatenate([part.noise for part in parts])
    return Shape(
        number,
        {layer: np.ones((len(noise), 1)), **below},
        np.concatenate([part.observed for part in parts]),
        noise,
    )


def parent_of(parts: Sequence[Subtree], node: Node, layer: str, shape: Shape) -> Subtree:
    """Return the subtree of ``node``, whose draw of ``layer`` is part of every curve below it."""
    own = {layer: np.ones(1)}
    silent = {name: np.zeros(factor.shape[1]) for name, factor in shape.units.items()}
    curves = {node: Curve(silent | own, ())}
    starts = dict.fromkeys(parts[0].shape.units, 0)
    for part in parts:
        for below, curve in part.curves.items():
            placed = {
                name: _placed(weights, starts[name], len(silent[name]))
                for name, weights in curve.weights.items()
            }
            curves[below] = Curve(placed | own, curve.shares)
        starts = {name: starts[name] + part.shape.units[name].shape[1] for name in starts}
    return Subtree(shape, np.concatenate([part.data for part in parts]), curves)


def _placed(weights: Array, start: int, size: int) -> Array:
    """Return ``weights`` from ``start`` on among zeros, ``size`` in all."""
    return np.pad(weights, (start, size - start - len(weights)))
