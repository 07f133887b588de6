"""Sequences of different lengths as one padded array, with masks of the visible entries."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array

__all__ = ["Sequences"]


@dataclass(frozen=True)
class Sequences:
    """K sequences, padded to the longest.

    Hidden entries and padding have weight zero. This integrates them out exactly, because the noise
    is independent between channels.

    Parameters
    ----------
    values : ndarray of shape (K, N, F)
        The entries; 0 where hidden.
    visible : ndarray of shape (K, N, F)
        1 where an entry is known, else 0.
    lengths : ndarray of shape (K,)
        Number of frames of each sequence.
    """

    values: Array
    visible: Array
    lengths: NDArray[np.intp]

    @classmethod
    def of(cls, arrays: Sequence[Array]) -> Self:
        """Pad arrays of shape (N_k, F), NaN where hidden."""
        lengths = np.array([len(array) for array in arrays])
        padded = np.full((len(arrays), lengths.max(), arrays[0].shape[1]), np.nan)
        for row, array in zip(padded, arrays, strict=True):
            row[: len(array)] = array
        visible = ~np.isnan(padded)
        return cls(np.where(visible, padded, 0.0), visible.astype(np.float64), lengths)

    @cached_property
    def frames(self) -> NDArray[np.bool_]:
        """(K, N) True at the frames of a sequence, False at its padding."""
        return np.asarray(np.arange(self.values.shape[1]) < self.lengths[:, None])

    @cached_property
    def counts(self) -> Array:
        """(K, F) number of visible entries."""
        return np.asarray(self.visible.sum(axis=1))

    @cached_property
    def squares(self) -> Array:
        """(K, F) sum of the squares of the visible entries."""
        return np.asarray((self.values**2).sum(axis=1))

    def rows(self, index: NDArray[np.intp]) -> Sequences:
        """Return the sequences at ``index``."""
        return Sequences(self.values[index], self.visible[index], self.lengths[index])

    def join(self, other: Sequences) -> Sequences:
        """Return these sequences followed by the others."""
        return Sequences.of([*self.arrays(), *other.arrays()])

    def arrays(self) -> list[Array]:
        """Return the array (N_k, F) of each sequence, NaN where hidden: the inverse of `of`."""
        return self.unpad(np.where(self.visible > 0, self.values, np.nan))

    def unpad(self, array: Array) -> list[Array]:
        """Return the rows (N_k, …) of each sequence of an array (K, N, …)."""
        return [row[:length] for row, length in zip(array, self.lengths, strict=True)]
