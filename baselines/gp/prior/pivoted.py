r"""Kernel matrices as :math:`\Lambda\Lambda^\top`, those of smooth kernels included.

The plain Cholesky factorisation fails on the Gram matrix of a smooth kernel, whose eigenvalues
fall below rounding error. With complete pivoting it stops when the largest remaining variance is
below 1e-14, a few dozen roundings. The trace of the remainder is then below 1e-14 of the matrix's,
far below any noise, and the number of columns is the numerical rank (Higham 2002, *Accuracy and
Stability of Numerical Algorithms*, §10.3; docs/mathematics/solvers.md, section 5, "Root and
trimming").
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import lapack, solve_triangular

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.basics.arrays import Array

__all__ = ["PivotedRoot"]


TOLERANCE = 1e-14
"""What is left out counts in proportion to the noise, which may be 1e-6, once for every entry that
bears on it, and extrapolation rests on it: at 1e-12 it cost a trend 0.3 % of its variance."""


@dataclass(frozen=True, eq=False)
class PivotedRoot:
    """The root Λ, such that Λ u with white u is a draw of the kernel's process.

    Parameters
    ----------
    kernel : StationaryKernel
        The kernel.
    lengthscale : float
        Its lengthscale.
    pivots : ndarray of shape (rank,)
        The times that the factorisation chose as pivots.
    triangle : ndarray of shape (rank, rank)
        Lower Cholesky factor of the kernel matrix at the pivots.
    values : ndarray of shape (N, rank)
        Λ at the times that were factorised.
    """

    kernel: StationaryKernel
    lengthscale: float
    pivots: Array
    triangle: Array
    values: Array

    @classmethod
    def of(cls, kernel: StationaryKernel, lengthscale: float, times: Array) -> PivotedRoot:
        """Factorise the kernel matrix at ``times`` (N,)."""
        gram = kernel.value(np.subtract.outer(times, times), lengthscale)
        factor, order, rank, _ = lapack.dpstrf(gram, tol=TOLERANCE, lower=1)
        lower = np.tril(factor[:, :rank])
        values = np.empty_like(lower)
        values[order - 1] = lower
        return cls(kernel, lengthscale, times[order[:rank] - 1], lower[:rank], values)

    def slope(self, times: Array) -> tuple[Array, Array]:
        r"""Return V (N, rank) and T (rank, rank) with ∂(Λ Λᵀ) = V Λᵀ + Λ Vᵀ − Λ T Λᵀ.

        ``times`` are those that were factorised, and ∂ is the derivative in log ℓ at fixed pivots
        p: :math:`\Lambda\Lambda^\top = k_{\cdot p} k_{pp}^{-1} k_{p \cdot}`, so that
        :math:`V = \partial k_{\cdot p} L^{-\top}` and
        :math:`T = L^{-1} \partial k_{pp} L^{-\top}`.
        """
        by_pivot = np.hstack([times, self.pivots])
        slopes = self.kernel.gradient(np.subtract.outer(self.pivots, by_pivot), self.lengthscale)
        solved = solve_triangular(self.triangle, slopes, lower=True, check_finite=False)
        at_times, at_pivots = np.split(solved, [len(times)], axis=1)
        inner = solve_triangular(self.triangle, at_pivots.T, lower=True, check_finite=False)
        return at_times.T, inner

    def at(self, times: Array) -> Array:
        """Return Λ at other times, (M, rank): the regression of the process there on u."""
        cross = self.kernel.value(np.subtract.outer(self.pivots, times), self.lengthscale)
        return np.asarray(solve_triangular(self.triangle, cross, lower=True).T)
