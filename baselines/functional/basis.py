"""Periodic functions as Fourier series: the basis, its roughness, and its shifts.

A function of the phase u, in cycles, is f(u) = bᵀ(u) c with P = 2H + 1 coefficients c of
b(u) = (1, cos 2πu, …, cos 2πHu, sin 2πu, …, sin 2πHu), so that value and every derivative are
equal at both ends of a cycle.
"""

from __future__ import annotations

import numpy as np

from mocapbench.basics.arrays import Array

__all__ = ["fourier", "norms", "roughness", "shift_matrices"]


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
    matrices[:, 0, 0] = 1.0
    matrices[:, cosine, cosine] = matrices[:, sine, sine] = np.cos(angles)
    matrices[:, cosine, sine] = -np.sin(angles)
    matrices[:, sine, cosine] = np.sin(angles)
    return matrices
