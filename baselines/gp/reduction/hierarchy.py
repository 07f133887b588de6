r"""From a tree of replicates to block problems, exactly.

A replicate is :math:`y_r = g + e_i + \dots + f_r + \varepsilon_r`, with one independent draw for
each node on the way from the root (eq. 5 and 8 of J. D. Gil López, *Hierarchical Multiple Output
Gaussian Processes for Human Motion Data*, MSc thesis, Universidad Tecnológica de Pereira, 2017).
*Siblings* whose subtrees have one shape, that is, the same numbers of nodes and the same visible
entries, are exchangeable. So the contrasts between them do not depend on their mean or on the
draws above, and the mean of R siblings has their covariance, divided by R, around the draws above.
Applied level by level, from the leaves up, this leaves the means at the root and, for each shape,
one block of deviations. A subtree is thus represented by a few mean curves, which are sums of the
draws inside it; its `Shape` says which, and is all that their covariance depends on. The symbols
are those of docs/mathematics/inference.md, section 2, "Trees of replicates".
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from mocapbench.baselines.gp.prior.parameters import CHILD
from mocapbench.baselines.gp.reduction.reduction import Reduction, Replicates
from mocapbench.baselines.gp.reduction.tree import Node, Tree, grow
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.basics.arrays import Array

__all__ = ["Deviations", "Shape", "Subtree", "reduce_hierarchy"]

NodeCurve = tuple[Mapping[str, Array], tuple[Target, ...]]
"""The curve of a node inside a subtree: for each layer the coefficients a (I,) of the subtree's
draws, and its further terms, in deviations from means."""


def reduce_hierarchy(replicates: Replicates, tree: Tree | None = None) -> Reduction:
    r"""Reduce replicates whose curves are draws around those of the nodes above them.

    In two layers, f_r ~ GP(g, K_f): with :math:`C = K_f + \Gamma` the mean curves of the patterns
    have covariance :math:`K_g + \delta_{pq} C / R_p`, and are independent of the deviations from
    them, which have covariance :math:`(\delta_{rs} - 1 / R_p)\, C` and rank :math:`R_p - 1`. The
    Jacobian of taking means is :math:`R_p^{-n_p/2}`.

    Parameters
    ----------
    replicates : Replicates
        The data.
    tree : Tree, optional
        From the root to the replicates; without it all of them are children of the root.
    """
    tree = tree or grow([str(r) for r in range(len(replicates.data))])
    deviations = Deviations()
    # Means and contrasts, level by level from the leaves to the root.
    level = _leaves(replicates, tree[CHILD])
    for layer in reversed([*tree][:-1]):
        level = _level_above(layer, level, deviations)
    means = level[()]
    # The terms of every node's curve; block 0 holds the means at the root.
    nodes = {
        node: _terms(means, tuple(tree), node) for of_layer in tree.values() for node in of_layer
    }
    zeros = np.zeros(replicates.data.shape[1])
    return Reduction(
        blocks=(
            means.shape.block(replicates.times, means.data[None], multiplicity=1),
            *deviations.blocks(replicates.times),
        ),
        replicates=tuple(nodes[leaf] for leaf in tree[CHILD]),
        trend=nodes[()],
        constant=deviations.log_jacobian,
        within_dof=zeros,
        within_scatter=zeros,
        nodes=nodes,
    )


@dataclass(frozen=True, eq=False)
class Shape:
    """The covariance structure of the P mean curves that a subtree is reduced to.

    Subtrees of one shape differ only in their draws and noise.

    Parameters
    ----------
    number : int
        Its place among the shapes of its level.
    units : mapping of str to ndarray of shape (P, I)
        C, for each layer the loadings of the mean curves on the draws in the subtree.
    observed : ndarray of bool, shape (P, D, N)
        Which entries of the mean curves are visible.
    noise : ndarray of shape (P,)
        ν, the factors of their noise variances.
    """

    number: int
    units: Mapping[str, Array]
    observed: NDArray[np.bool_]
    noise: Array

    def block(self, times: Array, data: Array, multiplicity: int) -> Block:
        """Return the problem of data vectors (h, P, D, N)."""
        noise = np.broadcast_to(self.noise[:, None, None], self.observed.shape)
        return Block(times, self.units, self.observed, data, noise, multiplicity).trim()

    def of_mean(self, size: int) -> Shape:
        """Return the shape of the mean of ``size`` subtrees: R^(−1/2) C and ν / R."""
        units = {layer: factor * size**-0.5 for layer, factor in self.units.items()}
        return replace(self, units=units, noise=self.noise / size)


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


class Deviations:
    """Deviations of siblings from their mean, by the shape and the number of the siblings.

    Families with the same shape and number are data vectors of one block: the covariance Π between
    the data vectors is a projection with a constant diagonal, 1 − 1 / R for families of R siblings
    (docs/mathematics/inference.md, section 2, "Trees of replicates").
    """

    def __init__(self) -> None:
        self.families: dict[tuple[Shape, int], list[Array]] = {}

    def add(self, shape: Shape, data: Array) -> tuple[int, int]:
        """Add the deviations (R, P, D, N) of a family.

        Returns
        -------
        block, column : int
            The index of the block that they are in, and that of the first sibling's data vector.
            Blocks are counted from 1, since block 0 holds the means at the root.
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
        """The log-Jacobian of taking means: −½ n log R for each family of R siblings."""
        return -0.5 * sum(
            float(len(families) * shape.observed.sum() * np.log(size))
            for (shape, size), families in self.families.items()
        )


def _leaves(replicates: Replicates, nodes: Sequence[Node]) -> Mapping[Node, Subtree]:
    """Return the replicates of which something is visible; their shapes are their patterns."""
    shapes: dict[bytes, Shape] = {}
    leaves = {}
    for node, data, observed in zip(nodes, replicates.data, replicates.observed, strict=True):
        if observed.any():
            new = Shape(len(shapes), {CHILD: np.ones((1, 1))}, observed[None], np.ones(1))
            shape = shapes.setdefault(observed.tobytes(), new)
            leaves[node] = Subtree(shape, data[None], {node: ({CHILD: np.ones(1)}, ())})
    return leaves


def _level_above(
    layer: str, level: Mapping[Node, Subtree], deviations: Deviations
) -> Mapping[Node, Subtree]:
    """Return the nodes above those of a level, each with a draw of ``layer``."""
    # The children of each node, by their shapes.
    families: dict[Node, dict[Shape, list[Subtree]]] = {}
    for node, subtree in level.items():
        families.setdefault(node[:-1], {}).setdefault(subtree.shape, []).append(subtree)
    # Nodes with the same shapes of children, in the same numbers, have one shape.
    shapes: dict[tuple[tuple[int, int], ...], Shape] = {}
    above = {}
    for node, by_shape in families.items():
        siblings = [by_shape[shape] for shape in sorted(by_shape, key=lambda shape: shape.number)]
        parts = [_average_siblings(alike, deviations) for alike in siblings]
        kind = tuple((alike[0].shape.number, len(alike)) for alike in siblings)
        new = _shape_above(layer, [part.shape for part in parts], len(shapes))
        above[node] = _join_children(parts, node, layer, shapes.setdefault(kind, new))
    return above


def _terms(means: Subtree, layers: Sequence[str], node: Node) -> tuple[Target, ...]:
    """Return the terms of a node's curve.

    A node of which nothing is visible has the curve of the nearest ancestor of which something is,
    plus independent draws of the layers in between.
    """
    visible = next(node[:n] for n in range(len(node), -1, -1) if node[:n] in means.curves)
    independent = dict.fromkeys(layers[len(visible) + 1 : len(node) + 1], 1.0)
    weights, terms = means.curves[visible]
    return (Target(weights, independent), *terms)


def _shape_above(layer: str, parts: Sequence[Shape], number: int) -> Shape:
    """Return the shape of a node, with a draw of ``layer``, above parts of these shapes."""
    # Draws below the node are those of one part each; the node's draw is in every curve.
    below = {name: block_diag(*(part.units[name] for part in parts)) for name in parts[0].units}
    noise = np.concatenate([part.noise for part in parts])
    return Shape(
        number,
        {layer: np.ones((len(noise), 1)), **below},
        np.concatenate([part.observed for part in parts]),
        noise,
    )


def _average_siblings(siblings: Sequence[Subtree], deviations: Deviations) -> Subtree:
    """Return the mean of siblings of one shape; the deviations from it go to ``deviations``."""
    shape, size = siblings[0].shape, len(siblings)
    if size == 1:
        return siblings[0]
    # The mean of the siblings' mean curves, and the deviations from it.
    data = np.stack([sibling.data for sibling in siblings])
    mean = data.mean(axis=0)
    block, first = deviations.add(shape, data - mean)
    # A node's curve with weights a: weights R^(−1/2) a in the mean, and a term a in the deviations.
    curves: dict[Node, NodeCurve] = {}
    for column, sibling in enumerate(siblings, start=first):
        for node, (weights, terms) in sibling.curves.items():
            scaled = {layer: a * size**-0.5 for layer, a in weights.items()}
            deviation = Target(weights, block=block, column=column)
            curves[node] = scaled, (*terms, deviation)
    return Subtree(shape.of_mean(size), mean, curves)


def _join_children(parts: Sequence[Subtree], node: Node, layer: str, shape: Shape) -> Subtree:
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
        The shape of the subtree, as given by `_shape_above`.
    """
    # The node's curve: weight 1 on the node's draw, 0 on the draws below.
    top = {layer: np.ones(1)}
    zeros = {name: np.zeros(factor.shape[1]) for name, factor in shape.units.items()}
    curves: dict[Node, NodeCurve] = {node: (zeros | top, ())}
    # A curve below: its weights at the places of its part's draws, and 1 on the node's draw.
    starts = dict.fromkeys(parts[0].shape.units, 0)
    for part in parts:
        for below, (weights, terms) in part.curves.items():
            placed = {
                name: _pad_weights(a, starts[name], len(zeros[name])) for name, a in weights.items()
            }
            curves[below] = placed | top, terms
        starts = {name: starts[name] + part.shape.units[name].shape[1] for name in starts}
    return Subtree(shape, np.concatenate([part.data for part in parts]), curves)


def _pad_weights(weights: Array, start: int, size: int) -> Array:
    """Return ``weights`` from index ``start`` on, among zeros: (size,)."""
    return np.pad(weights, (start, size - start - len(weights)))
