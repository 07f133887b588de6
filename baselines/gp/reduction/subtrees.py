"""Subtrees of replicates, reduced to their mean curves from the leaves to the root.

A subtree is represented by a few mean curves, which are sums of the draws inside it; its `Shape`
says which. Siblings of one shape are replaced by their mean, and their deviations from it are set
aside (docs/mathematics/inference.md, section 2, "Trees of replicates").
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.gp.reduction.deviations import Deviations
from mocapbench.baselines.gp.reduction.reduction import PosteriorTerm
from mocapbench.baselines.gp.reduction.shapes import Shape
from mocapbench.baselines.gp.reduction.tree import Node
from mocapbench.baselines.gp.solvers.block import Target
from mocapbench.basics.arrays import Array

__all__ = ["NodeCurve", "Subtree", "mean_of", "parent_of"]


@dataclass(frozen=True, eq=False)
class NodeCurve:
    """The curve of a node inside a subtree.

    Parameters
    ----------
    weights : mapping of str to ndarray of shape (I,)
        a, for each layer the coefficients of the subtree's draws.
    terms : tuple of PosteriorTerm
        Its further terms, in deviations from means.
    """

    weights: Mapping[str, Array]
    terms: tuple[PosteriorTerm, ...]


@dataclass(frozen=True, eq=False)
class Subtree:
    """A node with all that is below it, or the mean of several.

    Parameters
    ----------
    shape : Shape
        The covariance structure of the mean curves.
    data : ndarray of shape (P, D, N)
        The mean curves, 0 where hidden.
    curves : mapping of tuple of str to NodeCurve
        The curves of its nodes.
    """

    shape: Shape
    data: Array
    curves: Mapping[Node, NodeCurve]


def mean_of(siblings: Sequence[Subtree], deviations: Deviations) -> Subtree:
    """Return the mean of siblings of one shape; the deviations from it go to ``deviations``."""
    shape, size = siblings[0].shape, len(siblings)
    if size == 1:
        return siblings[0]
    # The mean of the siblings' mean curves, and the deviations from it.
    data = np.stack([sibling.data for sibling in siblings])
    mean = data.mean(axis=0)
    block, first = deviations.add(shape, data - mean)
    # A node's curve with weights a: weights R^(−1/2) a in the mean, and a term a in the deviations.
    curves = {}
    for column, sibling in enumerate(siblings, start=first):
        for node, curve in sibling.curves.items():
            scaled = {layer: weights * size**-0.5 for layer, weights in curve.weights.items()}
            deviation = PosteriorTerm(block, column, Target(curve.weights, {}))
            curves[node] = NodeCurve(scaled, (*curve.terms, deviation))
    return Subtree(shape.of_mean(size), mean, curves)


def parent_of(parts: Sequence[Subtree], node: Node, layer: str, shape: Shape) -> Subtree:
    """Return the subtree of ``node``, whose draw of ``layer`` is part of every curve below it.

    Parameters
    ----------
    parts : sequence of Subtree
        The children of the node, one for each shape: single nodes or means of siblings.
    node : tuple of str
        The node.
    layer : str
        The layer of the node's draw.
    shape : Shape
        The shape of the subtree, as given by `shape_above`.
    """
    # The node's curve: weight 1 on the node's draw, 0 on the draws below.
    top = {layer: np.ones(1)}
    zeros = {name: np.zeros(factor.shape[1]) for name, factor in shape.units.items()}
    curves = {node: NodeCurve(zeros | top, ())}
    # A curve below: its weights at the places of its part's draws, and 1 on the node's draw.
    starts = dict.fromkeys(parts[0].shape.units, 0)
    for part in parts:
        for below, curve in part.curves.items():
            placed = {
                name: _pad_weights(weights, starts[name], len(zeros[name]))
                for name, weights in curve.weights.items()
            }
            curves[below] = NodeCurve(placed | top, curve.terms)
        starts = {name: starts[name] + part.shape.units[name].shape[1] for name in starts}
    return Subtree(shape, np.concatenate([part.data for part in parts]), curves)


def _pad_weights(weights: Array, start: int, size: int) -> Array:
    """Return ``weights`` from index ``start`` on, among zeros: (size,)."""
    return np.pad(weights, (start, size - start - len(weights)))
