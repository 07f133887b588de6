"""Inference by one dense Cholesky factorisation per block.

The covariance of the visible entries is formed, factorised and inverted in place by LAPACK. Its
adjoint is summed over units into one (D N, D N) array per layer. There a single matrix product
with the kernels and their derivatives gives the gradients of all coregionalisation matrices and
lengthscales at once (docs/mathematics/solvers.md, section 4).

The covariance is filled and read by pairs of units. Only one triangle is ever computed: an adjoint
whose off-diagonal entries stand twice above the diagonal and nowhere below has the same inner
product with every symmetric matrix.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import blas, lapack, solve_triangular

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.baselines.gp.solvers.solver import (
    BlockPosterior,
    SingularCovarianceError,
    Solver,
)
from mocapbench.basics.arrays import Array

__all__ = ["Dense"]


OVERHEAD = 1.5e7
"""Cost of a block apart from its factorisation, in operations (about a millisecond)."""
GridIndex = slice | NDArray[np.intp]
"""Visible entries of a unit's (D, N) grid; a slice where all are visible, which spares copies."""


class Dense(Solver):
    """Cost O(n³) in the number n of visible entries of a block; nothing else matters."""

    name: ClassVar[str] = "dense"

    def evaluate(self, block: Block, parameters: Parameters) -> tuple[float, Parameters]:
        """Return the log-density of the block's data and its gradient."""
        # α = K⁻¹ z, log|K| + n log 2π, the log-density and its adjoint K̄.
        data = _visible_data(block)
        factor = _factorise(self.kernel, block, parameters)
        alpha, _ = lapack.dpotrs(factor, data, lower=1)
        log_determinant = 2.0 * np.log(np.diagonal(factor)).sum() + len(data) * np.log(2.0 * np.pi)
        value = -0.5 * (block.multiplicity * log_determinant + np.vdot(data, alpha))
        adjoint = _invert_for_adjoint(factor, alpha, block.multiplicity)
        return float(value), self._gradient(block, parameters, adjoint)

    def condition(self, block: Block, parameters: Parameters) -> BlockPosterior:
        """Return the posterior given the block's data."""
        return _DensePosterior(self.kernel, block, parameters)

    def work(self, block: Block, parameters: Parameters) -> float:  # noqa: ARG002
        """Return n³ / 2 plus an overhead, for n visible entries."""
        return 0.5 * float(block.n_visible) ** 3 + OVERHEAD

    def _gradient(self, block: Block, parameters: Parameters, adjoint: Array) -> Parameters:
        layers = {
            name: self._layer_gradient(block, layer, _sum_over_units(block, name, adjoint))
            if name in block.units
            else layer.zeros()
            for name, layer in parameters.layers.items()
        }
        # ∂ log β_d = β_d Σ_pt s_pdt K̄_pdt,pdt
        noise = np.zeros(block.observed.shape)
        noise[block.observed] = np.diagonal(adjoint)
        by_output = (noise * block.noise_scale).sum(axis=(0, 2))
        return Parameters(layers, parameters.noise * by_output)

    def _layer_gradient(
        self, block: Block, layer: LayerParameters, adjoint: Array
    ) -> LayerParameters:
        """Return the gradient in one layer; ``adjoint`` (D, N, D, N) is that of Σ_q B_q ⊗ k_q."""
        matrices = layer.matrices
        n_components, n_outputs, _ = matrices.shape
        # k_q and ∂k_q of every component.
        scales = layer.lengthscales[:, None, None]
        kernels = np.stack(
            [self.kernel.value(block.lags, scales), self.kernel.gradient(block.lags, scales)]
        )
        # ⟨T_de, k_q⟩ = B̄_q and ⟨T_de, ∂k_q⟩, for every pair of outputs d, e.
        by_pair = np.ascontiguousarray(adjoint.transpose(0, 2, 1, 3)).reshape(n_outputs**2, -1)
        moments = (kernels.reshape(2 * n_components, -1) @ by_pair.T).reshape(
            2, n_components, n_outputs, n_outputs
        )
        return layer.pull_back((matrices * moments[1]).sum(axis=(1, 2)), moments[0])


class _DensePosterior(BlockPosterior):
    def __init__(self, kernel: StationaryKernel, block: Block, parameters: Parameters) -> None:
        self.kernel, self.block, self.parameters = kernel, block, parameters
        self.factor = _factorise(kernel, block, parameters)
        self.alpha, _ = lapack.dpotrs(self.factor, _visible_data(block), lower=1)

    def predict(self, target: Target, times: Array) -> tuple[Array, Array]:
        layers = {name: self.parameters.layers[name] for name in self.block.units}
        n_outputs = self.block.observed.shape[1]
        # The mean K_* α, then L⁻¹ K_*ᵀ, whose squared columns are diag(K_* K⁻¹ K_*ᵀ).
        cross = self._cross(target, times)
        mean = (cross @ self.alpha).T.reshape(-1, n_outputs, len(times))
        explained = solve_triangular(
            self.factor, cross.T, lower=True, overwrite_b=True, check_finite=False
        )
        # diag(K_**), and the variance as the difference.
        prior = sum(target.prior_scale(name) * layer.variances for name, layer in layers.items())
        reduction = np.square(explained).sum(axis=0).reshape(n_outputs, len(times))
        variance = np.maximum(np.reshape(prior, (-1, 1)) - reduction, 0.0)
        return mean, self.block.variance_scale * variance

    def _cross(self, target: Target, times: Array) -> Array:
        """Return K_*, (D M, n), the covariance of the target with the visible entries."""
        block = self.block
        lags = np.subtract.outer(times, block.times)
        n_rows = block.observed.shape[1] * len(times)
        cross = np.zeros((n_rows, block.n_visible))
        for name, factor in block.units.items():
            covariance = self.parameters.layers[name].covariance(self.kernel, lags)
            scales = factor @ target.weights[name]
            for (columns, span), scale in zip(_unit_spans(block), scales, strict=True):
                cross[:, span] += scale * covariance.reshape(n_rows, -1)[:, columns]
        return cross


def _visible_data(block: Block) -> Array:
    """Return (n, h), the data vectors as columns."""
    return np.asfortranarray(block.data[:, block.observed].T)


def _unit_spans(block: Block) -> Iterator[tuple[GridIndex, slice]]:
    """Yield for each unit its visible grid entries, and their places in a data vector."""
    start = 0
    for positions, observed in zip(block.positions, block.observed, strict=True):
        entries = slice(None) if observed.all() else positions
        yield entries, slice(start, start + len(positions))
        start += len(positions)


def _factorise(kernel: StationaryKernel, block: Block, parameters: Parameters) -> Array:
    """Return the lower Cholesky factor of the covariance of the visible entries, (n, n).

    The covariance is filled above the diagonal of a C-ordered array. That is below the diagonal
    of its transpose, the Fortran-ordered array that LAPACK takes without a copy.

    Raises
    ------
    SingularCovarianceError
        If the covariance is not numerically positive definite.
    """
    n = block.n_visible
    covariance = np.zeros((n, n))
    # Σ_τ U_τ ⊗ Σ_q B_τq ⊗ k_τq, and the noise β_d s_pdt.
    for name in block.units:
        grid = parameters.layers[name].covariance(kernel, block.lags)
        flat = grid.reshape(grid.shape[0] * grid.shape[1], -1)
        for weight, (rows, columns), place in _unit_pairs(block, name):
            covariance[place] += weight * flat[rows][:, columns]
    noise = parameters.noise[:, None] * block.noise_scale
    covariance.flat[:: n + 1] += noise[block.observed]
    factor, info = lapack.dpotrf(covariance.T, lower=1, clean=1, overwrite_a=1)
    if info != 0:
        raise SingularCovarianceError(parameters)
    return np.asarray(factor)


def _invert_for_adjoint(factor: Array, alpha: Array, multiplicity: int) -> Array:
    """Return K̄ = ½(Σ_r α_r α_rᵀ − ρ K⁻¹) as an upper triangle that counts for both, (n, n).

    Parameters
    ----------
    factor : ndarray of shape (n, n)
        The lower Cholesky factor of K; it is overwritten.
    alpha : ndarray of shape (n, h)
        K⁻¹ z of the h data vectors.
    multiplicity : int
        ρ.
    """
    # K⁻¹, then Σ_r α_r α_rᵀ − ρ K⁻¹, both in one triangle.
    inverse, _ = lapack.dpotri(factor, lower=1, overwrite_c=1)
    adjoint = blas.dsyrk(1.0, alpha, beta=-multiplicity, c=inverse, lower=1, overwrite_c=1).T
    adjoint.flat[:: len(adjoint) + 1] *= 0.5
    return np.asarray(adjoint)


def _sum_over_units(block: Block, name: str, adjoint: Array) -> Array:
    """Return T, the adjoint of a layer's Σ_q B_q ⊗ k_q: (D, N, D, N)."""
    _, n_outputs, n_times = block.observed.shape
    total = np.zeros((n_outputs * n_times, n_outputs * n_times))
    for weight, (rows, columns), (row_span, column_span) in _unit_pairs(block, name):
        wide = np.zeros((row_span.stop - row_span.start, len(total)))
        wide[:, columns] = weight * adjoint[row_span, column_span]
        total[rows] += wide
    return total.reshape(n_outputs, n_times, n_outputs, n_times)


def _unit_pairs(
    block: Block, name: str
) -> Iterator[tuple[float, tuple[GridIndex, GridIndex], tuple[slice, slice]]]:
    """Yield U[p, p'], the grid entries and the matrix block, for p ≤ p' that the layer couples."""
    spans = list(_unit_spans(block))
    gram = block.grams[name]
    for p, (rows, row_span) in enumerate(spans):
        for (columns, column_span), weight in zip(spans[p:], gram[p, p:], strict=True):
            if weight != 0.0:
                yield weight, (rows, columns), (row_span, column_span)
