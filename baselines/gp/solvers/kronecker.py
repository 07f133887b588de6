r"""Inference in one component with complete data, by two eigendecompositions.

In the basis of `kronecker_basis` the covariance is diagonal, so that everything costs
:math:`O(N^3 + D^3)` and, for each data vector, :math:`O(D N (D + N))` (docs/mathematics/solvers.md,
section 7). It solves the deviations from a mean in an intrinsic coregionalisation model, and
independent draws from one.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.baselines.gp.solvers.kronecker_basis import KroneckerBasis, is_kronecker
from mocapbench.baselines.gp.solvers.solver import BlockPosterior, Solver
from mocapbench.basics.arrays import Array

__all__ = ["Kronecker"]


OVERHEAD = 8e6
"""Cost of a block apart from its matrix products, in operations (about half a millisecond)."""
EIGEN = 12.0
"""Operations of a symmetric eigendecomposition, in cubes of the side, at the speed of products."""


class Kronecker(Solver):
    """Cost O(N³ + D³ + h D N (D + N)); for one component and complete data only."""

    name: ClassVar[str] = "kronecker"
    needs: ClassVar[str] = (
        "one component, one layer and complete recordings, as in the deviations from a mean"
    )

    def evaluate(self, block: Block, parameters: Parameters) -> tuple[float, Parameters]:
        """Return the log-density of the block's data and its gradient."""
        basis = KroneckerBasis.of(self.kernel, block, parameters)
        return basis.log_density, _gradient(self.kernel, basis)

    def condition(self, block: Block, parameters: Parameters) -> BlockPosterior:
        """Return the posterior given the block's data."""
        return _KroneckerPosterior(self.kernel, KroneckerBasis.of(self.kernel, block, parameters))

    def work(self, block: Block, parameters: Parameters) -> float:
        """Return 12 (N³ + D³) + 1.5 h D N (D + N) plus an overhead, or infinity."""
        if not is_kronecker(block, parameters):
            return np.inf
        h, _, n_outputs, n_times = block.data.shape
        products = 1.5 * h * n_outputs * n_times * (n_outputs + n_times)
        return float(EIGEN * (n_times**3 + n_outputs**3) + products + OVERHEAD)


def _gradient(kernel: StationaryKernel, basis: KroneckerBasis) -> Parameters:
    block, rho, data = basis.block, basis.block.multiplicity, basis.data
    # Zᵀ ∂k Z and ρ / σ.
    slope = basis.times.T @ kernel.gradient(block.lags, basis.layer.lengthscales[0]) @ basis.times
    inverse = rho / basis.variances
    # B̄ = (u / 2) Ṽ [Σ_r a_r diag(μ) a_rᵀ − ρ diag_i Σ_j μ_j / σ_ij] Ṽᵀ
    outer = np.tensordot(data * basis.spectrum, data, axes=((0, 2), (0, 2)))
    by_matrix = 0.5 * basis.gram * basis.rotate(outer - np.diag(inverse @ basis.spectrum))
    # ∂ log ℓ = ½ [⟨Zᵀ ∂k Z, Σ_r a_rᵀ diag(λ) a_r⟩ − ρ Σ_ij λ_i (Zᵀ ∂k Z)_jj / σ_ij]
    weighted = np.tensordot(data * basis.strengths[:, None], data, axes=((0, 1), (0, 1)))
    by_scale = 0.5 * (np.vdot(slope, weighted) - basis.strengths @ inverse @ np.diagonal(slope))
    # ∂ν_d = ½ (Ṽ [Σ_r a_r a_rᵀ − ρ diag_i Σ_j 1 / σ_ij] Ṽᵀ)_dd
    squares = np.tensordot(data, data, axes=((0, 2), (0, 2)))
    by_noise = 0.5 * np.diagonal(basis.rotate(squares - np.diag(inverse.sum(axis=1))))
    layers = {name: layer.zeros() for name, layer in basis.parameters.layers.items()}
    (name,) = block.units
    layers[name] = LayerParameters(
        np.array([by_scale]), basis.layer.coregionalisation.pull_back(by_matrix[None])
    )
    return Parameters(layers, basis.noise * by_noise)


class _KroneckerPosterior(BlockPosterior):
    def __init__(self, kernel: StationaryKernel, basis: KroneckerBasis) -> None:
        self.kernel, self.basis = kernel, basis

    def predict(self, target: Target, times: Array) -> tuple[Array, Array]:
        basis, b = self.basis, self.basis.layer.coregionalisation
        ((name, factor),) = basis.block.units.items()
        scale = float(factor[0] @ target.weights[name])
        lags = np.subtract.outer(times, basis.block.times)
        # K_* in the basis is the product of C a B Ṽ and k(t_*, t) Z.
        by_time = self.kernel.value(lags, basis.layer.lengthscales[0]) @ basis.times
        by_output = scale * b.matrices[0] @ basis.outputs
        mean = by_output @ basis.data @ by_time.T
        # diag(K_** − K_* K⁻¹ K_*ᵀ)
        explained = by_output**2 @ (1.0 / basis.variances) @ (by_time**2).T
        variance = np.maximum(target.prior_scale(name) * b.variances[:, None] - explained, 0.0)
        return mean, basis.block.variance_scale * variance
