r"""Inference in one component with complete data, by two eigendecompositions.

The covariance of a single unit with one component, all of whose entries are visible with a noise
:math:`\nu_d` that does not change in time, is :math:`K = u B \otimes k + \operatorname{diag}(\nu)
\otimes I`. With :math:`u\, \nu^{-1/2} B \nu^{-1/2} = V \operatorname{diag}(\lambda) V^\top` and
:math:`k = Z \operatorname{diag}(\mu) Z^\top` both terms are diagonal in the basis
:math:`\nu^{1/2} V \otimes Z`,

.. math:: K = (\nu^{1/2} V \otimes Z) \operatorname{diag}(1 + \lambda_i \mu_j)
          (\nu^{1/2} V \otimes Z)^\top.

Everything costs :math:`O(N^3 + D^3)` and, for each data vector, :math:`O(D N (D + N))`. It solves
the deviations from a mean in an intrinsic coregionalisation model, and independent draws from one.
The symbols are those of docs/mathematics/solvers.md, section 7.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.baselines.gp.solvers.solver import BlockPosterior, Solver
from mocapbench.basics.arrays import Array

__all__ = ["Kronecker"]


OVERHEAD = 8e6
"""Cost of a block apart from its matrix products, in operations (about half a millisecond)."""
EIGEN = 12.0
"""Operations of a symmetric eigendecomposition, in cubes of the side, at the speed of products."""


@dataclass(frozen=True, eq=False)
class KroneckerBasis:
    """The diagonal covariance of a block, and the block's data in its basis.

    Parameters
    ----------
    block, parameters, layer : Block, Parameters, LayerParameters
        The problem and its one layer.
    noise : ndarray of shape (D,)
        ν.
    gram : float
        u.
    outputs : ndarray of shape (D, D)
        Ṽ = ν^(−1/2) V.
    times : ndarray of shape (N, N)
        Z.
    strengths : ndarray of shape (D,)
        λ.
    spectrum : ndarray of shape (N,)
        μ.
    variances : ndarray of shape (D, N)
        σ = 1 + λ_i μ_j.
    data : ndarray of shape (h, D, N)
        a_r = Ṽᵀ z_r Z / σ.
    squares : float
        Σ_r z_rᵀ K⁻¹ z_r.
    """

    block: Block
    parameters: Parameters
    layer: LayerParameters
    noise: Array
    gram: float
    outputs: Array
    times: Array
    strengths: Array
    spectrum: Array
    variances: Array
    data: Array
    squares: float

    @classmethod
    def of(cls, kernel: StationaryKernel, block: Block, parameters: Parameters) -> KroneckerBasis:
        """Diagonalise ``block`` at ``parameters``."""
        ((name, gram),) = block.grams.items()
        layer = parameters.layers[name]
        noise = parameters.noise * block.noise_scale[0, :, 0]
        roots, u = np.sqrt(noise), float(gram[0, 0])
        # λ and V, μ and Z.
        strengths, vectors = np.linalg.eigh(u * layer.matrices[0] / np.outer(roots, roots))
        spectrum, times = np.linalg.eigh(kernel.value(block.lags, layer.lengthscales[0]))
        # Ṽ, σ, t_r = Ṽᵀ z_r Z and a_r = t_r / σ.
        outputs = vectors / roots[:, None]
        variances = 1.0 + np.outer(strengths, spectrum)
        rotated = outputs.T @ block.data[:, 0] @ times
        data = rotated / variances
        return cls(
            block,
            parameters,
            layer,
            noise,
            u,
            outputs,
            times,
            strengths,
            spectrum,
            variances,
            data,
            float(np.vdot(rotated, data)),
        )

    @property
    def log_density(self) -> float:
        """The log-density of the block's data."""
        n_times = len(self.spectrum)
        log_determinant = np.log(self.variances).sum() + n_times * np.log(self.noise).sum()
        log_scale = log_determinant + self.block.n_visible * np.log(2.0 * np.pi)
        return float(-0.5 * (self.block.multiplicity * log_scale + self.squares))

    def rotate(self, matrix: Array) -> Array:
        """Return Ṽ X Ṽᵀ for a matrix X, (D, D)."""
        return np.asarray(self.outputs @ matrix @ self.outputs.T)


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
        if not _is_kronecker(block, parameters):
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
    layers[name] = basis.layer.pull_back(np.array([by_scale]), by_matrix[None])
    return Parameters(layers, basis.noise * by_noise)


class _KroneckerPosterior(BlockPosterior):
    def __init__(self, kernel: StationaryKernel, basis: KroneckerBasis) -> None:
        self.kernel, self.basis = kernel, basis

    def predict(self, target: Target, times: Array) -> tuple[Array, Array]:
        basis, layer = self.basis, self.basis.layer
        ((name, factor),) = basis.block.units.items()
        scale = float(factor[0] @ target.weights[name])
        lags = np.subtract.outer(times, basis.block.times)
        # K_* in the basis is the product of C a B Ṽ and k(t_*, t) Z.
        by_time = self.kernel.value(lags, layer.lengthscales[0]) @ basis.times
        by_output = scale * layer.matrices[0] @ basis.outputs
        mean = by_output @ basis.data @ by_time.T
        # diag(K_** − K_* K⁻¹ K_*ᵀ)
        explained = by_output**2 @ (1.0 / basis.variances) @ (by_time**2).T
        variance = np.maximum(target.prior_scale(name) * layer.variances[:, None] - explained, 0.0)
        return mean, basis.block.variance_scale * variance


def _is_kronecker(block: Block, parameters: Parameters) -> bool:
    """Return whether a block has one unit, one component, no hidden entry and constant noise."""
    layers = [parameters.layers[name] for name in block.units]
    return bool(
        len(block.observed) == 1
        and block.observed.all()
        and [layer.log_lengthscales.size for layer in layers] == [1]
        and np.all(block.noise_scale == block.noise_scale[:, :, :1])
    )
