"""The covariance of a block's visible entries, its Cholesky factor and its adjoint.

A block is filled and read by pairs of units. Only one triangle is ever computed: an adjoint whose
off-diagonal entries stand twice above the diagonal and nowhere below has the same inner product
with every symmetric matrix (docs/mathematics/solvers.md, section 4).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import blas, lapack

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.block import Block
from mocapbench.baselines.gp.solvers.solver import SingularCovarianceError
from mocapbench.basics.arrays import Array

__all__ = ["GridIndex", "adjoint_of", "factorise", "sum_over_units", "unit_spans"]


GridIndex = slice | NDArray[np.intp]
"""Visible entries of a unit's (D, N) grid; a slice where all are visible, which spares copies."""


def unit_spans(block: Block) -> Iterator[tuple[GridIndex, slice]]:
    """Yield for each unit its visible grid entries, and their places in a data vector."""
    start = 0
    for positions, observed in zip(block.positions, block.observed, strict=True):
        entries = slice(None) if observed.all() else positions
        yield entries, slice(start, start + len(positions))
        start += len(positions)


def factorise(kernel: StationaryKernel, block: Block, parameters: Parameters) -> Array:
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


def adjoint_of(factor: Array, alpha: Array, multiplicity: int) -> Array:
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


def sum_over_units(block: Block, name: str, adjoint: Array) -> Array:
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
    spans = list(unit_spans(block))
    gram = block.grams[name]
    for p, (rows, row_span) in enumerate(spans):
        for (columns, column_span), weight in zip(spans[p:], gram[p, p:], strict=True):
            if weight != 0.0:
                yield weight, (rows, columns), (row_span, column_span)
