"""Rough estimates of noise, lengthscale and curves from data in standard units.

They follow docs/mathematics/prediction.md, section 10, "Start".
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from mocapbench.baselines.gp.reduction.replicates import Replicates
from mocapbench.baselines.gp.reduction.tree import Tree
from mocapbench.basics.arrays import Array

__all__ = ["layer_curves", "noise_variance", "shared_lengthscale"]


NOISE_RANGE = 1e-3, 1e-1
"""Least and largest noise variance that a search starts from."""


def noise_variance(replicates: Replicates) -> Array:
    """Return β (D,), from the errors of interpolating each visible entry between its neighbours."""
    squares, counts = np.zeros(replicates.data.shape[1]), np.zeros(replicates.data.shape[1])
    for d, times, values in _series(replicates):
        # e = y − θ y₋ − (1 − θ) y₊, whose variance is β (1 + θ² + (1 − θ)²) on a straight line.
        theta = (times[2:] - times[1:-1]) / (times[2:] - times[:-2])
        errors = values[1:-1] - theta * values[:-2] - (1.0 - theta) * values[2:]
        squares[d] += (errors**2 / (1.0 + theta**2 + (1.0 - theta) ** 2)).sum()
        counts[d] += len(errors)
    return np.clip(squares / np.maximum(counts, 1.0), *NOISE_RANGE)


def shared_lengthscale(replicates: Replicates, noise: Array) -> float:
    """Return ℓ₀, the time in which an output changes by one standard deviation.

    It is the root of Σ Δt² / Σ max(Δy² − 2 β_d, 0) over neighbouring visible entries, clipped to
    between 1 / N of the span of the times and the span. ``noise`` is β (D,).
    """
    squares = steps = 0.0
    for d, times, values in _series(replicates):
        squares += float(np.maximum(np.diff(values) ** 2 - 2.0 * noise[d], 0.0).sum())
        steps += float((np.diff(times) ** 2).sum())
    span = float(np.ptp(replicates.times)) or 1.0
    shortest = span / len(replicates.times)
    return float(np.clip(np.sqrt(steps / squares) if squares else span, shortest, span))


def layer_curves(replicates: Replicates, tree: Tree) -> Mapping[str, Array]:
    """Return for each layer empirical curves of it, (M, D, N), 0 where nothing is visible.

    They are the mean curves of its M nodes, less those of the nodes above.
    """
    curves, above = {}, np.zeros(replicates.data.shape)
    for layer, nodes in tree.items():
        names = list(dict.fromkeys(nodes))
        members = [[r for r, node in enumerate(nodes) if node == name] for name in names]
        # The mean over the replicates below each node.
        counts = np.stack([replicates.observed[below].sum(axis=0) for below in members])
        sums = np.stack([replicates.data[below].sum(axis=0) for below in members])
        means = sums / np.maximum(counts, 1)
        # Less the mean of the node above, which all replicates below a node have in common.
        first = [below[0] for below in members]
        curves[layer] = np.where(counts > 0, means - above[first], 0.0)
        above = means[[names.index(node) for node in nodes]]
    return curves


def _series(replicates: Replicates) -> Iterator[tuple[int, Array, Array]]:
    """Yield output, times and values of the visible entries of every replicate's outputs."""
    for data, observed in zip(replicates.data, replicates.observed, strict=True):
        for d, (values, visible) in enumerate(zip(data, observed, strict=True)):
            yield d, replicates.times[visible], values[visible]
