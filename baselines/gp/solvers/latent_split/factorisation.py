"""The factorisations of the latent split, which likelihood and prediction share.

The symbols are those of docs/mathematics/solvers.md, section 5, "Value". m is the number of rows,
K that of white coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.common.cholesky import invert
from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.block import Block
from mocapbench.baselines.gp.solvers.entries import Entries
from mocapbench.baselines.gp.solvers.latent_split.independent_parts import invert_parts
from mocapbench.baselines.gp.solvers.latent_split.latents import Latents
from mocapbench.baselines.gp.solvers.solver import Mapper, refuse_singular
from mocapbench.basics.arrays import Array

__all__ = ["Factorisation"]


@dataclass(frozen=True, eq=False)
class Factorisation:
    """The covariance A K_v Aᵀ + blockdiag E_d of a block, factorised, and α = K⁻¹ z.

    Parameters
    ----------
    kernel : StationaryKernel
        The kernel of every component.
    block : Block
        The problem.
    parameters : Parameters
        The parameters at which it is evaluated.
    latents : Latents
        The latent functions.
    kernels : ndarray of shape (n_components, m²)
        U_τ ⊗ k_τ, for the components of all layers of the block.
    precision : ndarray of shape (D, m, m)
        F_d = E_d⁻¹, 0 where hidden.
    rooted_gram : tuple of ndarray of shape (N, K)
        G Λ, the rows of each latent function.
    inverse : ndarray of shape (K, K)
        S⁻¹, the posterior covariance of the white coordinates.
    log_determinant : float
        Σ_d log|E_d| + log|S|.
    white : ndarray of shape (K, h)
        u, the posterior mean of the white coordinates.
    shared : ndarray of shape (n, m, h)
        Σ_i c_i ⊗ Λ_i u_i, the sum of the posterior means of each column's functions, at the
        rows.
    residual, alpha : ndarray of shape (D, m, h)
        r = z − A Λ u and α = K⁻¹ z = F r at the rows.
    """

    kernel: StationaryKernel
    block: Block
    parameters: Parameters
    latents: Latents
    kernels: Array
    precision: Array
    rooted_gram: tuple[Array, ...]
    inverse: Array
    log_determinant: float
    white: Array
    shared: Array
    residual: Array
    alpha: Array

    @classmethod
    def of(
        cls, kernel: StationaryKernel, block: Block, parameters: Parameters, mapper: Mapper
    ) -> Factorisation:
        """Factorise ``block`` at ``parameters``.

        Raises
        ------
        SingularCovarianceError
            If some E_d or S is not numerically positive definite.
        """
        latents, entries = Latents.of(kernel, block, parameters), block.entries
        # F_d, G Λ, S and S⁻¹.
        kernels, precision, log_parts = invert_parts(kernel, block, parameters, mapper)
        rooted = _rooted_gram(latents, entries, precision)
        inverse = _system(latents, rooted)
        with refuse_singular(parameters):
            log_system = invert(inverse)
        # u = S⁻¹ Λᵀ Aᵀ F z, A Λ u, the residual r and α = F r.
        data = entries.gather_rows(block.data)
        white = inverse @ whiten(latents, entries, precision @ data)
        shared = _sum_shared(latents, entries, white)
        residual = data - np.tensordot(latents.weights.T, shared, axes=1)
        return cls(
            kernel,
            block,
            parameters,
            latents,
            kernels,
            precision,
            rooted,
            inverse,
            log_parts + log_system,
            white,
            shared,
            residual,
            precision @ residual,
        )

    @property
    def log_density(self) -> float:
        """The log-density of the block's data."""
        # zᵀ K⁻¹ z = rᵀ F r + uᵀ u, and ρ (log|K| + n log 2π).
        squares = np.vdot(self.residual, self.alpha) + np.vdot(self.white, self.white)
        log_scale = self.log_determinant + self.block.n_visible * np.log(2.0 * np.pi)
        return float(-0.5 * (self.block.multiplicity * log_scale + squares))


def whiten(latents: Latents, entries: Entries, values: Array) -> Array:
    """Return Λᵀ Aᵀ of ``values`` (D, m, h), (K, h)."""
    white = np.empty((latents.n_white, values.shape[2]))
    for latent, folded in zip(latents.functions, project(latents, entries, values), strict=True):
        white[latent.white] = latent.values.T @ folded
    return white


def project(latents: Latents, entries: Entries, values: Array) -> list[Array]:
    """Return Aᵀ of ``values`` (D, m, h), (N, h) for each latent function."""
    by_column = np.tensordot(latents.weights, values, axes=1)
    return [entries.fold(latent.units, by_column[latent.column]) for latent in latents.functions]


def _rooted_gram(latents: Latents, entries: Entries, precision: Array) -> tuple[Array, ...]:
    """Return G Λ, (N, K) for each latent function."""
    # Σ_d w_ad w_bd F_d for each pair of columns a ≤ b: section 5, "Value".
    n_times, n_rows = entries.n_times, len(entries.unit)
    rooted = tuple(np.empty((n_times, latents.n_white)) for _ in latents.functions)
    weighted = latents.products @ precision.reshape(len(precision), -1)
    by_pair = weighted.reshape(-1, n_rows, n_rows)
    # Block (i, j) of G is that of its columns, folded by the loadings of the units on i and on j.
    for (a, b), matrix in zip(latents.pairs, by_pair, strict=True):
        for i in latents.by_column[a]:
            one = latents.functions[i]
            rows = entries.fold(one.units, matrix).T
            for j in latents.by_column[b]:
                other = latents.functions[j]
                block = entries.fold(other.units, rows)
                rooted[j][:, one.white] = block @ one.values
                rooted[i][:, other.white] = block.T @ other.values
    return rooted


def _system(latents: Latents, rooted: tuple[Array, ...]) -> Array:
    """Return the diagonal and lower triangle of S = I + Λᵀ G Λ, (K, K)."""
    system = np.eye(latents.n_white)
    for latent, row in zip(latents.functions, rooted, strict=True):
        before = slice(latent.white.stop)
        system[latent.white, before] += latent.values.T @ row[:, before]
    return system


def _sum_shared(latents: Latents, entries: Entries, white: Array) -> Array:
    """Return Σ_i c_i ⊗ Λ_i u_i over the functions of each column, (n, m, h)."""
    shared = np.zeros((len(latents.columns), len(entries.unit), white.shape[1]))
    for latent in latents.functions:
        curve = latent.values @ white[latent.white]
        shared[latent.column] += entries.unfold(latent.units, curve)
    return shared
