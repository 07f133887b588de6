"""What curves tell about coefficients: sums over their visible entries, by curve and channel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.functional.basis import fourier
from mocapbench.basics.arrays import Array

__all__ = ["CurveStatistics"]


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
        parts = [_sums(fourier(phases, n_harmonics), values) for phases, values in curves]
        return cls(*(np.stack(part) for part in zip(*parts, strict=True)))

    def rows(self, index: NDArray[np.intp]) -> Self:
        """Return the statistics of the curves at ``index``."""
        return type(self)(
            self.grams[index], self.cross[index], self.squares[index], self.counts[index]
        )

    def shift_curves(self, matrices: Array) -> Self:
        """Return those of each curve with its phases shifted by its own matrix (J, P, P)."""
        left = matrices[:, None]
        grams = left @ self.grams @ left.swapaxes(-1, -2)
        cross = (left @ self.cross[..., None])[..., 0]
        return type(self)(grams, cross, self.squares, self.counts)


def _sums(basis: Array, values: Array) -> tuple[Array, Array, Array, Array]:
    visible = ~np.isnan(values)
    known = np.where(visible, values, 0.0)
    outer = (basis[:, :, None] * basis[:, None, :]).reshape(len(basis), -1)
    weights = visible.astype(np.float64)
    n_functions = basis.shape[1]
    grams = (weights.T @ outer).reshape(-1, n_functions, n_functions)
    return grams, known.T @ basis, (known**2).sum(axis=0), weights.sum(axis=0)
