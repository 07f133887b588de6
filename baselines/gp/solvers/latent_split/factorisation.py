"""The factorisations of the latent split, shared by likelihood and prediction.

The symbols are those of `mocapbench.baselines.gp.solvers.latent_split.solver`; m is the number of
sites and K that of white coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.threads import Mapper
from mocapbench.baselines.gp.prior.kernels import Kernel
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.block import Block
from mocapbench.baselines.gp.solvers.cholesky import invert
from mocapbench.baselines.gp.solvers.entries import Entries
from mocapbench.baselines.gp.solvers.latent_split.independent_parts import OwnParts
from mocapbench.baselines.gp.solvers.latent_split.latents import Latents

__all__ = ["Split"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Split:
    """A block's covariance A K_v Aᵀ + blockdiag E_d, factorised, and its data, solved for.

    Parameters
    ----------
    block : Block
        The problem.
    parameters : Parameters
        Where it is evaluated.
    latents : Latents
        The latent functions.
    own : OwnParts
        E and F.
    rooted_gram : tuple of ndarray of shape (N, K)
        G Λ, the rows of each latent function.
    inverse : ndarray of shape (K, K)
        S⁻¹, the posterior covariance of the white coordinates.
    log_determinant : float
        Σ_d log|E_d| + log|S|.
    white : ndarray of shape (K, h)
        u, the posterior mean of the white coordinates.
    shared : ndarray of shape (n, m, h)
        The posterior mean of what each column of weights multiplies, at the sites.
    residual, alpha : ndarray of shape (D, m, h)
        r = z − A Λ u and α = K⁻¹ z = F r at the sites.
    """

    block: Block
    parameters: Parameters
    latents: Latents
    own: OwnParts
    rooted_gram: tuple[Array, ...]
    inverse: Array
    log_determinant: float
    white: Array
    shared: Array
    residual: Array
    alpha: Array

    @classmethod
    def of(cls, kernel: Kernel, block: Block, parameters: Parameters, mapper: Mapper) -> Split:
        """Factorise ``block`` at ``parameters``."""
        latents, entries = Latents.of(kernel, block, parameters), block.entries
        own = OwnParts.of(kernel, block, parameters, mapper)
        rooted = _rooted_gram(latents, entries, own.precision)
        inverse = _system(latents, rooted)
        log_system = invert(inverse, parameters)
        data = entries.at_sites(block.data)
        white = inverse @ whiten(latents, entries, own.precision @ data)
        shared = _shared(latents, entries, white)
        residual = data - np.tensordot(latents.weights.T, shared, axes=1)
        return cls(
            block,
            parameters,
            latents,
            own,
            rooted,
            inverse,
            own.log_determinant + log_system,
            white,
            shared,
            residual,
            own.precision @ residual,
        )

    @property
    def log_density(self) -> float:
        """The log-density of the block's data."""
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
    """Return G Λ; the blocks of G are the foldings of Σ_d w_a w_b F_d."""
    n_times, n_sites = entries.n_times, len(entries.unit)
    rooted = tuple(np.empty((n_times, latents.n_white)) for _ in latents.functions)
    weighted = latents.products @ precision.reshape(len(precision), -1)
    by_pair = weighted.reshape(-1, n_sites, n_sites)
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
    """Return S = I + Λᵀ G Λ, (K, K), on the diagonal and below."""
    system = np.eye(latents.n_white)
    for latent, row in zip(latents.functions, rooted, strict=True):
        before = slice(latent.white.stop)
        system[latent.white, before] += latent.values.T @ row[:, before]
    return system


def _shared(latents: Latents, entries: Entries, white: Array) -> Array:
    """Return Σ_i c_i ⊗ Λ_i u_i over the functions of each column, (n, m, h)."""
    shared = np.zeros((len(latents.columns), len(entries.unit), white.shape[1]))
    for latent in latents.functions:
        curve = latent.values @ white[latent.white]
        shared[latent.column] += entries.unfold(latent.units, curve)
    return shared
