r"""Where the searches for parameters start.

The first start follows from the data in standard units (docs/mathematics/prediction.md, section 10,
"Start"). The leading directions of the mean curves start :math:`W` of the parent, those of the
deviations from them :math:`W` of the child. :math:`\kappa` starts at a tenth of the layer's
variance, and noise and lengthscales at rough estimates. Nothing in the data says which
direction goes with which lengthscale, so the next four starts assign them in other ways; further
starts are random around the first.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from mocapbench.baselines.common.signs import orient_vectors
from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.baselines.gp.reduction.reduction import Replicates
from mocapbench.baselines.gp.reduction.tree import Tree
from mocapbench.basics.arrays import Array

__all__ = [
    "layer_curves",
    "noise_variance",
    "perturb_start",
    "shared_lengthscale",
    "start_from_data",
    "vary_start",
]


NOISE_RANGE = 1e-3, 1e-1
"""Least and largest noise variance that a search starts from."""
KAPPA_SHARE = 0.1
"""Share of a layer's variance that κ starts with."""
OTHER_WEIGHTS = 0.5
"""W of the second to fifth start, relative to the first. All of the variance settles too early for
the directions of the data, which mix those of the components."""
SHORTER = 0.5**1.5
"""The lengthscales of the second to fifth start, relative to the first."""
ALIKE = 0.1
"""How far apart the log-lengthscales of the fourth start are, relative to the first."""
MIN_VARIANCE = 1e-2
"""Least variance that a direction of a layer starts with: at 0 the gradient vanishes."""


def start_from_data(
    replicates: Replicates,
    tree: Tree,
    n_components: Mapping[str, int],
    rank: int,
    within: Array,
) -> Parameters:
    """Return a start, from data in standard units.

    Parameters
    ----------
    replicates : Replicates
        The data.
    tree : Tree
        For each layer, the node of each replicate.
    n_components : mapping of str to int
        Q of each layer.
    rank : int
        Number of columns of each W_q.
    within : ndarray of shape (D,)
        Least noise variance to start with: that of replicates which a model takes for repeated
        observations of one function, otherwise 0.
    """
    noise = noise_variance(replicates)
    lengthscale = shared_lengthscale(replicates, noise)
    curves = layer_curves(replicates, tree)
    return Parameters(
        {
            name: LayerParameters(
                _log_lengthscales(lengthscale, size), *_share_covariance(curves[name], size, rank)
            )
            for name, size in n_components.items()
        },
        np.log(np.maximum(noise, within)),
    )


def vary_start(first: Parameters, n: int, rng: np.random.Generator) -> list[Parameters]:
    """Return ``n`` starts: the given one, four that change its scales, and random ones near it.

    In the second, the lengthscales of the last layer are in reverse order, in the third those of
    the layers above; in the fourth, all are nearly equal; in the fifth, each direction of every
    layer has the lengthscale of the next one, and the last direction that of the first. Starts that
    are then the same, as with one component, count as one: fewer than ``n`` are returned.
    """
    *above, last = first.layers
    fixed = [
        first,
        _change_layers(first, dict.fromkeys([last], _reverse_lengthscales)),
        _change_layers(first, dict.fromkeys(above, _reverse_lengthscales)),
        _change_layers(first, dict.fromkeys(first.layers, _nearly_equal)),
        _change_layers(first, dict.fromkeys(first.layers, _roll_lengthscales)),
    ]
    distinct = {start.flat.tobytes(): start for start in fixed[:n]}
    return [*distinct.values(), *(perturb_start(first, rng) for _ in range(n - len(fixed)))]


def noise_variance(replicates: Replicates) -> Array:
    """Return β (D,), from the errors of interpolating each visible entry between its neighbours."""
    squares, counts = np.zeros(replicates.data.shape[1]), np.zeros(replicates.data.shape[1])
    for d, times, values in _visible_series(replicates):
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
    for d, times, values in _visible_series(replicates):
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


def _reverse_lengthscales(log_lengthscales: Array) -> Array:
    return log_lengthscales[::-1]


def _nearly_equal(log_lengthscales: Array) -> Array:
    mean = log_lengthscales.mean()
    return np.asarray(mean + ALIKE * (log_lengthscales - mean))


def _roll_lengthscales(log_lengthscales: Array) -> Array:
    return np.roll(log_lengthscales, -1)


def _change_layers(
    first: Parameters, changes: Mapping[str, Callable[[Array], Array]]
) -> Parameters:
    """Return the start with less of the variance in W, and shorter lengthscales, in every layer.

    ``changes`` has, by layer, the map of its log-lengthscales.
    """

    def layer(name: str, old: LayerParameters) -> LayerParameters:
        changed = np.log(SHORTER) + changes.get(name, np.array)(old.log_lengthscales)
        return replace(old, log_lengthscales=changed, weights=OTHER_WEIGHTS * old.weights)

    return replace(first, layers={name: layer(name, old) for name, old in first.layers.items()})


def perturb_start(start: Parameters, rng: np.random.Generator) -> Parameters:
    """Return a random start near another.

    The components of a layer exchange their lengthscales. Then log ℓ, log √κ and log β move by 0.5
    times a standard normal; W is normal, with the root mean square of each column of the given
    start.
    """

    def layer(old: LayerParameters) -> LayerParameters:
        size = np.sqrt(np.mean(old.weights**2, axis=1, keepdims=True)) if old.weights.size else 0.0
        lengthscales = rng.permutation(old.log_lengthscales)
        return LayerParameters(
            lengthscales + 0.5 * rng.standard_normal(lengthscales.shape),
            size * rng.standard_normal(old.weights.shape),
            old.kappa_roots * np.exp(0.5 * rng.standard_normal(old.kappa_roots.shape)),
        )

    return Parameters(
        {name: layer(old) for name, old in start.layers.items()},
        start.log_noise + 0.5 * rng.standard_normal(start.log_noise.shape),
    )


def _log_lengthscales(lengthscale: float, n_components: int) -> Array:
    """Return (Q,) logarithms of lengthscales around the given one, a factor of two apart."""
    octaves = np.arange(n_components) - 0.5 * (n_components - 1)
    return np.asarray(np.log(lengthscale) + np.log(2.0) * octaves)


def _share_covariance(curves: Array, n_components: int, rank: int) -> tuple[Array, Array]:
    """Return W (Q, D, rank) and √κ (Q, D), which share the covariance of curves (M, D, N)."""
    n_outputs = curves.shape[1]
    # Scaled so that the squares of an output's row add up to its variance.
    known = np.maximum((curves != 0.0).sum(axis=(0, 2)), 1)
    scaled = curves.transpose(1, 0, 2).reshape(n_outputs, -1) / np.sqrt(known)[:, None]
    directions, singular, _ = np.linalg.svd(scaled, full_matrices=False)
    directions = orient_vectors(directions)  # the signs of W decide what is drawn
    # The columns of W: singular directions in turn. If they are too few they repeat, with their
    # variance divided.
    n_columns = n_components * rank
    chosen = np.arange(n_columns) % len(singular)
    repeats = np.bincount(chosen, minlength=len(singular))[chosen]
    size = np.sqrt(np.maximum(singular[chosen] ** 2, MIN_VARIANCE) / repeats)
    weights = directions[:, chosen] * size
    # √κ: a tenth of the output's variance, divided between the components.
    variance = np.maximum(np.square(scaled).sum(axis=1), MIN_VARIANCE)
    return (
        weights.reshape(n_outputs, rank, n_components).transpose(2, 0, 1),
        np.tile(np.sqrt(KAPPA_SHARE * variance / n_components), (n_components, 1)),
    )


def _visible_series(replicates: Replicates) -> Iterator[tuple[int, Array, Array]]:
    """Yield output, times and values of the visible entries of every replicate's outputs."""
    for data, observed in zip(replicates.data, replicates.observed, strict=True):
        for d, (values, visible) in enumerate(zip(data, observed, strict=True)):
            yield d, replicates.times[visible], values[visible]
