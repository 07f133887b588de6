"""Inference by one dense Cholesky factorisation per block.

The covariance of the visible entries is formed, factorised and inverted in place by LAPACK. Its
adjoint is summed over units into one (D N, D N) array per layer. There a single matrix product
with the kernels and their derivatives gives the gradients of all coregionalisation matrices and
lengthscales at once (docs/mathematics/solvers.md, section 4).
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from scipy.linalg import lapack, solve_triangular

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.baselines.gp.solvers.dense_covariance import (
    adjoint_of,
    factorise,
    sum_over_units,
    unit_spans,
)
from mocapbench.baselines.gp.solvers.solver import BlockPosterior, Solver
from mocapbench.basics.arrays import Array

__all__ = ["Dense"]


OVERHEAD = 1.5e7
"""Cost of a block apart from its factorisation, in operations (about a millisecond)."""


class Dense(Solver):
    """Cost O(n³) in the number n of visible entries of a block; nothing else matters."""

    name: ClassVar[str] = "dense"

    def evaluate(self, block: Block, parameters: Parameters) -> tuple[float, Parameters]:
        """Return the log-density of the block's data and its gradient."""
        # α = K⁻¹ z, log|K| + n log 2π, the log-density and its adjoint K̄.
        data = _visible_data(block)
        factor = factorise(self.kernel, block, parameters)
        alpha, _ = lapack.dpotrs(factor, data, lower=1)
        log_determinant = 2.0 * np.log(np.diagonal(factor)).sum() + len(data) * np.log(2.0 * np.pi)
        value = -0.5 * (block.multiplicity * log_determinant + np.vdot(data, alpha))
        adjoint = adjoint_of(factor, alpha, block.multiplicity)
        return float(value), self._gradient(block, parameters, adjoint)

    def condition(self, block: Block, parameters: Parameters) -> BlockPosterior:
        """Return the posterior given the block's data."""
        return _DensePosterior(self.kernel, block, parameters)

    def work(self, block: Block, parameters: Parameters) -> float:  # noqa: ARG002
        """Return n³ / 2 plus an overhead, for n visible entries."""
        return 0.5 * float(block.n_visible) ** 3 + OVERHEAD

    def _gradient(self, block: Block, parameters: Parameters, adjoint: Array) -> Parameters:
        layers = {
            name: self._layer_gradient(block, layer, sum_over_units(block, name, adjoint))
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
        matrices = layer.coregionalisation.matrices
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
        return LayerParameters(
            (matrices * moments[1]).sum(axis=(1, 2)),
            layer.coregionalisation.pull_back(moments[0]),
        )


class _DensePosterior(BlockPosterior):
    def __init__(self, kernel: StationaryKernel, block: Block, parameters: Parameters) -> None:
        self.kernel, self.block, self.parameters = kernel, block, parameters
        self.factor = factorise(kernel, block, parameters)
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
        prior = sum(
            target.prior_scale(name) * layer.coregionalisation.variances
            for name, layer in layers.items()
        )
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
            for (columns, span), scale in zip(unit_spans(block), scales, strict=True):
                cross[:, span] += scale * covariance.reshape(n_rows, -1)[:, columns]
        return cross


def _visible_data(block: Block) -> Array:
    """Return (n, h), the data vectors as columns."""
    return np.asfortranarray(block.data[:, block.observed].T)
