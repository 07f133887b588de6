r"""From a tree of replicates to block problems, exactly.

A replicate is :math:`y_r = g + e_i + \dots + f_r + \varepsilon_r`, with one independent draw for
each node on the way from the root (eq. 5 and 8 of J. D. Gil López, *Hierarchical Multiple Output
Gaussian Processes for Human Motion Data*, MSc thesis, Universidad Tecnológica de Pereira, 2017).
*Siblings* whose subtrees have one shape, that is, the same numbers of nodes and the same visible
entries, are exchangeable. So the contrasts between them do not depend on their mean or on the
draws above, and the mean of R siblings has their covariance, divided by R, around the draws above.
Applied level by level, this leaves the means at the root and, for each shape, one block of
deviations (docs/mathematics/inference.md, section 2).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mocapbench.baselines.gp.prior.parameters import CHILD
from mocapbench.baselines.gp.reduction.reduction import Reduction
from mocapbench.baselines.gp.reduction.replicates import Replicates
from mocapbench.baselines.gp.reduction.subtrees import (
    Deviations,
    Shape,
    Subtree,
    average_siblings,
    join_children,
    shape_above,
)
from mocapbench.baselines.gp.reduction.tree import Node, Tree, grow
from mocapbench.baselines.gp.solvers.block import Target

__all__ = ["reduce_hierarchy"]


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
        parts = [average_siblings(alike, deviations) for alike in siblings]
        kind = tuple((alike[0].shape.number, len(alike)) for alike in siblings)
        new = shape_above(layer, [part.shape for part in parts], len(shapes))
        above[node] = join_children(parts, node, layer, shapes.setdefault(kind, new))
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
