r"""Where to start the search for parameters, and within which bounds.

The data themselves tell most of it, in standard units. The leading directions of the mean curves
start :math:`W` of the parent, those of the deviations that of the child; :math:`\kappa` starts at
a tenth of the layer's variance; second differences bound the noise, first differences the
lengthscales.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.prior.coregionalisation import Coregionalisation
from mocapbench.baselines.gp.prior.parameters import Layer, Parameters
from mocapbench.baselines.gp.reduction.replicates import Replicates
from mocapbench.baselines.gp.reduction.tree import Tree

__all__ = ["bounds", "data_driven", "perturbed"]

Array = NDArray[np.float64]

MIN_NOISE, MAX_NOISE = 1e-6, 10.0
MAX_LOADING = 30.0
"""Bound of |W| and √κ, in standard deviations of the output: beyond any fit, short of overflow."""
START_NOISE = 1e-3, 1e-1
KAPPA_SHARE = 0.1
MIN_VARIANCE = 1e-2
"""Least variance that a layer starts with: where it is 0, so is its gradient."""


def data_driven(
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
        Whose draw of each layer they take part in.
    n_components : mapping of str to int
        Q of each layer.
    rank : int
        Number of columns of each W_q.
    within : ndarray of shape (D,)
        Variance that the model can explain by noise alone.
    """
    noise = _noise(replicates)
    lengthscale = _lengthscale(replicates, noise)
    curves = _curves(replicates, tree)
    return Parameters(
        {
            name: Layer(_spread(lengthscale, size), _coregionalisation(curves[name], size, rank))
            for name, size in n_components.items()
        },
        np.log(np.maximum(noise, within)),
    )


def bounds(parameters: Parameters, times: Array) -> tuple[Parameters, Parameters]:
    """Return the lower and upper bounds of the parameters, as points of their space.

    A lengthscale lies between half the shortest step and ten spans of ``times`` (N,).
    """
    steps = np.diff(times) if len(times) > 1 else np.ones(1)
    shortest, longest = np.log(0.5 * steps.min()), np.log(10.0 * steps.sum())

    def constant(lengthscale: float, loading: float, noise: float) -> Parameters:
        layers = {
            name: Layer(
                np.full_like(layer.log_lengthscales, lengthscale),
                Coregionalisation(
                    np.full_like(layer.coregionalisation.weights, loading),
                    np.full_like(layer.coregionalisation.kappa_roots, loading),
                ),
            )
            for name, layer in parameters.layers.items()
        }
        return Parameters(layers, np.full_like(parameters.log_noise, noise))

    return (
        constant(shortest, -MAX_LOADING, np.log(MIN_NOISE)),
        constant(longest, MAX_LOADING, np.log(MAX_NOISE)),
    )


def perturbed(start: Parameters, rng: np.random.Generator) -> Parameters:
    """Return a random start of the same scales: new directions, lengthscales within a factor."""

    def layer(old: Layer) -> Layer:
        b = old.coregionalisation
        size = np.sqrt(np.mean(b.weights**2, axis=1, keepdims=True)) if b.weights.size else 0.0
        return Layer(
            old.log_lengthscales + 0.5 * rng.standard_normal(old.log_lengthscales.shape),
            Coregionalisation(
                size * rng.standard_normal(b.weights.shape),
                b.kappa_roots * np.exp(0.5 * rng.standard_normal(b.kappa_roots.shape)),
            ),
        )

    return Parameters(
        {name: layer(old) for name, old in start.layers.items()},
        start.log_noise + 0.5 * rng.standard_normal(start.log_noise.shape),
    )


def _noise(replicates: Replicates) -> Array:
    """Return (D,), from the errors of interpolating each visible entry between its neighbours."""
    squares, counts = np.zeros(replicates.data.shape[1]), np.zeros(replicates.data.shape[1])
    for d, times, values in _series(replicates):
        share = (times[2:] - times[1:-1]) / (times[2:] - times[:-2])
        errors = values[1:-1] - share * values[:-2] - (1.0 - share) * values[2:]
        squares[d] += (errors**2 / (1.0 + share**2 + (1.0 - share) ** 2)).sum()
        counts[d] += len(errors)
    return np.clip(squares / np.maximum(counts, 1.0), *START_NOISE)


def _lengthscale(replicates: Replicates, noise: Array) -> float:
    """Return the time in which an output of unit variance and the observed slopes would change."""
    squares = steps = 0.0
    for d, times, values in _series(replicates):
        squares += float(np.maximum(np.diff(values) ** 2 - 2.0 * noise[d], 0.0).sum())
        steps += float((np.diff(times) ** 2).sum())
    span = float(np.ptp(replicates.times)) or 1.0
    shortest = span / len(replicates.times)
    return float(np.clip(np.sqrt(steps / squares) if squares else span, shortest, span))


def _series(replicates: Replicates) -> Iterator[tuple[int, Array, Array]]:
    """Yield output, times and values of the visible entries of every replicate's outputs."""
    for data, observed in zip(replicates.data, replicates.observed, strict=True):
        for d, (values, seen) in enumerate(zip(data, observed, strict=True)):
            yield d, replicates.times[seen], values[seen]


def _spread(lengthscale: float, n_components: int) -> Array:
    """Return (Q,) logarithms of lengthscales around the given one, a factor of two apart."""
    octaves = np.arange(n_components) - 0.5 * (n_components - 1)
    return np.asarray(np.log(lengthscale) + np.log(2.0) * octaves)


def _curves(replicates: Replicates, tree: Tree) -> Mapping[str, Array]:
    """Return for each layer empirical curves of it, (M, D, N), 0 where nothing is known.

    They are the mean curves of its nodes, less those of the nodes above.
    """
    curves, above = {}, np.zeros(replicates.data.shape)
    for layer, nodes in tree.items():
        names = list(dict.fromkeys(nodes))
        members = [[r for r, node in enumerate(nodes) if node == name] for name in names]
        counts = np.stack([replicates.observed[each].sum(axis=0) for each in members])
        sums = np.stack([replicates.data[each].sum(axis=0) for each in members])
        means = sums / np.maximum(counts, 1)
        first = [each[0] for each in members]
        curves[layer] = np.where(counts > 0, means - above[first], 0.0)
        above = means[[names.index(node) for node in nodes]]
    return curves


def _coregionalisation(curves: Array, n_components: int, rank: int) -> Coregionalisation:
    """Divide the covariance of the curves between the components."""
    n_outputs = curves.shape[1]
    known = np.maximum((curves != 0.0).sum(axis=(0, 2)), 1)
    scaled = curves.transpose(1, 0, 2).reshape(n_outputs, -1) / np.sqrt(known)[:, None]
    directions, singular, _ = np.linalg.svd(scaled, full_matrices=False)
    n_columns = n_components * rank
    chosen = np.arange(n_columns) % len(singular)
    repeats = np.bincount(chosen, minlength=len(singular))[chosen]
    size = np.sqrt(np.maximum(singular[chosen] ** 2, MIN_VARIANCE) / repeats)
    weights = directions[:, chosen] * size
    variance = np.maximum(np.square(scaled).sum(axis=1), MIN_VARIANCE)
    return Coregionalisation(
        weights.reshape(n_outputs, rank, n_components).transpose(2, 0, 1),
        np.tile(np.sqrt(KAPPA_SHARE * variance / n_components), (n_components, 1)),
    )
