"""The factorisations of the latent split, shared by likelihood and prediction.

The symbols are those of `mocapbench.baselines.gp.latent_split`; K is the number of white
coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.block import Block
from mocapbench.baselines.gp.cholesky import factorise, invert_factor
from mocapbench.baselines.gp.kernels import Kernel
from mocapbench.baselines.gp.latents import Latents
from mocapbench.baselines.gp.own import OwnPrecision, own_precision
from mocapbench.baselines.gp.parameters import Parameters
from mocapbench.baselines.gp.unit_pairs import unit_pairs

__all__ = ["Split"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Split:
    """A block's covariance A K_v Aᵀ + blockdiag E_d, factorised, and its data, solved for.

    Parameters
    ----------
    kernel : Kernel
        The kernel of every component.
    block : Block
        The problem.
    parameters : Parameters
        Where it is evaluated.
    latents : Latents
        The n latent functions.
    precision : OwnPrecision
        F.
    gram : ndarray of shape (n, n, N, N)
        G, the blocks of Aᵀ F A.
    rooted_gram : ndarray of shape (n, N, K)
        G Λ.
    factor, inverse : ndarray of shape (K, K)
        The lower Cholesky factor of S, and S⁻¹, the posterior covariance of the white coordinates.
    log_determinant : float
        Σ_d log|E_d| + log|S|.
    white : ndarray of shape (K, h)
        u, the posterior mean of the white coordinates.
    residual, alpha : tuple of ndarray of shape (n_d, h)
        r = z − A Λ u and α = K⁻¹ z = F r at the visible entries of each output.
    """

    kernel: Kernel
    block: Block
    parameters: Parameters
    latents: Latents
    precision: OwnPrecision
    gram: Array
    rooted_gram: Array
    factor: Array
    inverse: Array
    log_determinant: float
    white: Array
    residual: tuple[Array, ...]
    alpha: tuple[Array, ...]

    @classmethod
    def of(cls, kernel: Kernel, block: Block, parameters: Parameters) -> Split:
        """Factorise ``block`` at ``parameters``."""
        latents, entries = Latents.of(kernel, block, parameters), block.entries
        precision = own_precision(kernel, block, parameters)
        gram = _gram(latents, precision.grid)
        rooted = _times_root(latents, gram)
        factor, log_determinant = factorise(_system(latents, rooted), parameters)
        inverse = invert_factor(factor)
        data = entries.pick(block.data.transpose(1, 2, 3, 0))
        weighted = entries.place(map(np.matmul, precision.matrices, data), len(block.data))
        white = _white_mean(latents, inverse, weighted)
        shared = entries.pick(_shared_part(latents, white))
        residual = tuple(map(np.subtract, data, shared))
        return cls(
            kernel,
            block,
            parameters,
            latents,
            precision,
            gram,
            rooted,
            factor,
            inverse,
            precision.log_determinant + log_determinant,
            white,
            residual,
            tuple(map(np.matmul, precision.matrices, residual)),
        )

    @property
    def log_density(self) -> float:
        """The log-density of the block's data."""
        squares = sum(map(np.vdot, self.residual, self.alpha)) + np.vdot(self.white, self.white)
        log_scale = self.log_determinant + self.block.n_visible * np.log(2.0 * np.pi)
        return float(-0.5 * (self.block.multiplicity * log_scale + squares))


def _gram(latents: Latents, grid: Array) -> Array:
    """Return G, (n, n, N, N)."""
    n, n_times = len(latents.labels), grid.shape[-1]
    gram = np.zeros((n, n, n_times, n_times))
    for pair in unit_pairs(latents):
        gram[pair.blocks] += np.tensordot(pair.products, grid[pair.units], axes=1)
    return gram


def _times_root(latents: Latents, gram: Array) -> Array:
    """Return G Λ, (n, N, K)."""
    n, _, n_times, _ = gram.shape
    rooted = np.empty((n, n_times, sum(root.shape[1] for root in latents.values)))
    for j, (own, root) in enumerate(zip(latents.slices, latents.values, strict=True)):
        rooted[:, :, own] = gram[:, j] @ root
    return rooted


def _system(latents: Latents, rooted: Array) -> Array:
    """Return S = I + Λᵀ G Λ, (K, K)."""
    system = np.eye(rooted.shape[2])
    for own, root, row in zip(latents.slices, latents.values, rooted, strict=True):
        system[own] += root.T @ row
    return system


def _white_mean(latents: Latents, inverse: Array, weighted: Array) -> Array:
    """Return u = S⁻¹ Λᵀ Aᵀ F z, (K, h); ``weighted`` (P, D, N, h) is F z."""
    right = np.empty((len(inverse), weighted.shape[3]))
    projected = latents.project(weighted)
    for own, root, one in zip(latents.slices, latents.values, projected, strict=True):
        right[own] = root.T @ one
    return np.asarray(inverse @ right)


def _shared_part(latents: Latents, white: Array) -> Array:
    """Return A Λ u, (P, D, N, h)."""
    return np.tensordot(latents.loadings, latents.curves(white), axes=((2,), (0,)))
