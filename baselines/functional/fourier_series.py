"""Periodic functions as Fourier series, and what curves with hidden entries tell of them.

A function of the phase u, in cycles, is f(u) = bᵀ(u) c with P = 2H + 1 coefficients c of
b(u) = (1, cos 2πu, …, cos 2πHu, sin 2πu, …, sin 2πHu), so that value and every derivative are
equal at both ends of a cycle. Regressions on curves need only sums over their visible entries.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array

__all__ = ["CurveStatistics", "fourier", "norms", "roughness", "shift_matrices"]


_FLAT = 1e-6  # weight of the constant: one that no entry determines is 0, the channel's mean


def fourier(phases: Array, n_harmonics: int) -> Array:
    """Return the basis at ``phases`` (…), in cycles: (…, P)."""
    phases = np.asarray(phases, dtype=np.float64)[..., None]
    angles = 2.0 * np.pi * phases * np.arange(1, n_harmonics + 1)
    return np.concatenate([np.ones_like(phases), np.cos(angles), np.sin(angles)], axis=-1)


def roughness(n_harmonics: int) -> Array:
    """Return the weight h⁴ of each squared coefficient in the penalty on curvature: (P,).

    ∫ f″(u)² du over a cycle is 8π⁴ Σ_h h⁴ (a_h² + b_h²), whose factor is left to the penalty's own.
    """
    harmonics = np.arange(1.0, n_harmonics + 1.0) ** 4
    return np.concatenate([[_FLAT], harmonics, harmonics])


def norms(n_harmonics: int) -> Array:
    """Return the mean square over a cycle of each function of the basis: (P,)."""
    return np.concatenate([[1.0], np.full(2 * n_harmonics, 0.5)])


def shift_matrices(shifts: Array, n_harmonics: int) -> Array:
    """Return R with b(u + s) = R b(u) for each of ``shifts`` s (G,), in cycles: (G, P, P)."""
    matrices = np.zeros((len(shifts), 2 * n_harmonics + 1, 2 * n_harmonics + 1))
    cosine, sine = np.arange(1, n_harmonics + 1), np.arange(n_harmonics + 1, 2 * n_harmonics + 1)
    angles = 2.0 * np.pi * np.asarray(shifts)[:, None] * cosine
    # cos(a + s) = cos a cos s − sin a sin s and sin(a + s) = sin a cos s + cos a sin s.
    matrices[:, 0, 0] = 1.0
    matrices[:, cosine, cosine] = matrices[:, sine, sine] = np.cos(angles)
    matrices[:, cosine, sine] = -np.sin(angles)
    matrices[:, sine, cosine] = np.sin(angles)
    return matrices


@dataclass(frozen=True, eq=False)
class CurveStatistics:
    """Sufficient statistics of J curves of D channels for P coefficients each.

    With v_i the visibility of an entry x_i at phase u_i, the squared error of coefficients c is
    Σ_i v_i (x_i − bᵀ(u_i) c)² = squares − 2 cᵀ cross + cᵀ gram c.

    Parameters
    ----------
    grams : ndarray of shape (J, D, P, P)
        Σ_i v_i b(u_i) bᵀ(u_i).
    cross : ndarray of shape (J, D, P)
        Σ_i v_i x_i b(u_i).
    squares, counts : ndarray of shape (J, D)
        Σ_i v_i x_i² and Σ_i v_i.
    """

    grams: Array
    cross: Array
    squares: Array
    counts: Array

    @classmethod
    def of(cls, curves: Sequence[tuple[Array, Array]], n_harmonics: int) -> Self:
        """Return those of curves given by phases (N_j,) and values (N_j, D), NaN where hidden."""
        parts = [_sum_entries(fourier(phases, n_harmonics), values) for phases, values in curves]
        return cls(*(np.stack(part) for part in zip(*parts, strict=True)))

    def rows(self, index: NDArray[np.intp]) -> Self:
        """Return the statistics of the curves at ``index``."""
        return type(self)(
            self.grams[index], self.cross[index], self.squares[index], self.counts[index]
        )

    def shift_curves(self, matrices: Array) -> Self:
        """Return those of each curve with its phases shifted by its own matrix (J, P, P)."""
        # Σ v (R b)(R b)ᵀ = R gram Rᵀ and Σ v x R b = R cross.
        left = matrices[:, None]
        grams = left @ self.grams @ left.swapaxes(-1, -2)
        cross = (left @ self.cross[..., None])[..., 0]
        return type(self)(grams, cross, self.squares, self.counts)


def _sum_entries(basis: Array, values: Array) -> tuple[Array, Array, Array, Array]:
    """Return the sums of a curve: (D, P, P), (D, P), (D,) and (D,)."""
    visible = ~np.isnan(values)
    known = np.where(visible, values, 0.0)
    outer = (basis[:, :, None] * basis[:, None, :]).reshape(len(basis), -1)
    weights = visible.astype(np.float64)
    n_functions = basis.shape[1]
    grams = (weights.T @ outer).reshape(-1, n_functions, n_functions)
    return grams, known.T @ basis, (known**2).sum(axis=0), weights.sum(axis=0)
