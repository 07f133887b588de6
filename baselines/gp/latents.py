"""The latent functions behind the shared part of a block's covariance."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.block import Block, Target
from mocapbench.baselines.gp.kernels import Kernel
from mocapbench.baselines.gp.parameters import Layer, Parameters
from mocapbench.baselines.gp.pivoted import PivotedRoot

__all__ = ["Label", "Latents"]

Array = NDArray[np.float64]


class Label(NamedTuple):
    """Which latent function: one for each column of W_q and each draw of the layer."""

    layer: str
    component: int
    column: int
    draw: int


@dataclass(frozen=True, eq=False)
class Latents:
    """A block's latent functions v_i = Λ_i u_i, with white u_i.

    Parameters
    ----------
    labels : tuple of Label
        Names of the n latent functions.
    roots : tuple of PivotedRoot
        Λ_i as functions of time.
    weights : ndarray of shape (n, D)
        w_i, how the outputs load on each.
    units : ndarray of shape (n, P)
        c_i, how the units do.
    values : tuple of ndarray of shape (N, rank_i)
        Λ_i at the block's times, 0 where no unit that sees the function has a visible entry.
    n_times : int
        The number N of the block's times.
    """

    labels: tuple[Label, ...]
    roots: tuple[PivotedRoot, ...]
    weights: Array
    units: Array
    values: tuple[Array, ...]
    n_times: int

    @classmethod
    def of(cls, kernel: Kernel, block: Block, parameters: Parameters) -> Latents:
        """List the latent functions of ``block``."""
        layers = {name: parameters.layers[name] for name in block.units}
        labels = tuple(
            label
            for name, layer in layers.items()
            for label in _labels(name, layer, block.units[name].shape[1])
        )
        weights = np.zeros((len(labels), block.observed.shape[1]))
        units = np.zeros((len(labels), block.observed.shape[0]))
        for i, (name, q, column, draw) in enumerate(labels):
            weights[i] = layers[name].coregionalisation.weights[q, :, column]
            units[i] = block.units[name][:, draw]
        seen = [block.observed[unit != 0.0].any(axis=(0, 1)) for unit in units]
        scales = [float(layers[label.layer].lengthscales[label.component]) for label in labels]
        roots = tuple(
            PivotedRoot.of(kernel, scale, block.times[times])
            for scale, times in zip(scales, seen, strict=True)
        )
        values = tuple(map(_at_rows, (root.values for root in roots), seen))
        return cls(labels, roots, weights, units, values, len(block.times))

    @property
    def loadings(self) -> Array:
        """(P, D, n) w_i c_iᵀ, how the units' outputs load on each latent function."""
        return self.units.T[:, None] * self.weights.T[None]

    @property
    def ends(self) -> NDArray[np.intp]:
        """(n,) where the white coordinates of each latent function end."""
        return np.cumsum([root.values.shape[1] for root in self.roots], dtype=np.intp)

    @property
    def slices(self) -> tuple[slice, ...]:
        """The white coordinates of each latent function."""
        ends = self.ends.tolist()
        return tuple(slice(start, end) for start, end in zip([0, *ends], ends, strict=False))

    def project(self, values: Array) -> Array:
        """Return Aᵀ of ``values`` (P, D, N, h), (n, N, h)."""
        by_unit = np.tensordot(self.weights, values, axes=((1,), (1,)))
        return np.asarray(np.einsum("np,npth->nth", self.units, by_unit))

    def curves(self, white: Array) -> Array:
        """Return Λ u, (n, N, h), for ``white`` (K, h)."""
        curves = np.empty((len(self.labels), self.n_times, white.shape[1]))
        for curve, own, root in zip(curves, self.slices, self.values, strict=True):
            curve[...] = root @ white[own]
        return curves

    @property
    def root(self) -> Array:
        """(N, K) all Λ_i side by side."""
        return np.hstack([np.empty((self.n_times, 0)), *self.values])

    def at(self, times: Array) -> Array:
        """Return (M, K), all Λ_i at other times, side by side."""
        return np.hstack([np.empty((len(times), 0)), *(root.at(times) for root in self.roots)])

    def coefficients(self, target: Target) -> Array:
        """Return (n, D), how the outputs of ``target`` load on each latent function."""
        draws = np.array([target.weights[label.layer][label.draw] for label in self.labels])
        return np.asarray(self.weights * draws[:, None])

    def spread(self, by_latent: Array) -> Array:
        """Return one row for each white coordinate, that of its latent function."""
        return np.asarray(np.repeat(by_latent, np.diff(self.ends, prepend=0), axis=0))


def _labels(name: str, layer: Layer, n_draws: int) -> Iterator[Label]:
    n_components, _, n_columns = layer.coregionalisation.weights.shape
    for q, column, draw in np.ndindex(n_components, n_columns, n_draws):
        yield Label(name, q, column, draw)


def _at_rows(values: Array, rows: NDArray[np.bool_]) -> Array:
    padded = np.zeros((len(rows), values.shape[1]))
    padded[rows] = values
    return padded
