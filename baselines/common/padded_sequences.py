"""Sequences of different lengths as one padded array, with masks of the visible entries."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.recordings import interpolate_channels
from mocapbench.basics.arrays import Array, Index

__all__ = ["Sequences"]


@dataclass(frozen=True)
class Sequences:
    """K sequences, padded to the longest.

    Hidden entries and padding have weight zero. This integrates them out exactly where the noise is
    independent between channels.

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
    lengths: Index

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

    @cached_property
    def leaders(self) -> Index:
        """(U,) the longest sequence of each group of sequences with the same mask.

        A Kalman filter's covariances depend on what was visible so far, and not on values.
        Sequences whose masks agree as far as both go share them: complete recordings of any length
        are one group.
        """
        return np.asarray(np.unique(self._leader_of))

    @cached_property
    def groups(self) -> Index:
        """(K,) the group of each sequence, an index into `leaders`."""
        return np.asarray(np.searchsorted(self.leaders, self._leader_of))

    @cached_property
    def _leader_of(self) -> Index:
        leaders: dict[int, list[int]] = {}
        for k in np.argsort(-self.lengths, kind="stable").tolist():
            leader = next((j for j in leaders if self._continues(j, k)), k)
            leaders.setdefault(leader, []).append(k)
        found = np.empty(len(self.lengths), dtype=np.intp)
        for leader, members in leaders.items():
            found[members] = leader
        return found

    def _continues(self, longer: int, k: int) -> bool:
        """Return whether the mask of sequence ``longer`` begins with that of sequence ``k``."""
        seen = slice(self.lengths[k])
        return np.array_equal(self.visible[longer, seen], self.visible[k, seen])

    def rows(self, index: Index) -> Self:
        """Return the sequences at ``index``, padded to the longest of them."""
        lengths = self.lengths[index]
        kept = slice(lengths.max(initial=0))
        return type(self)(self.values[index][:, kept], self.visible[index][:, kept], lengths)

    def join(self, other: Sequences) -> Sequences:
        """Return these sequences followed by the others."""
        return Sequences.of([*self.arrays(), *other.arrays()])

    def arrays(self) -> list[Array]:
        """Return the array (N_k, F) of each sequence, NaN where hidden: the inverse of `of`."""
        return self.unpad(np.where(self.visible > 0, self.values, np.nan))

    def unpad(self, array: Array) -> list[Array]:
        """Return the rows (N_k, …) of each sequence of an array (K, N, …)."""
        return [row[:length] for row, length in zip(array, self.lengths, strict=True)]

    def interpolate_hidden(self) -> list[Array]:
        """Return each sequence (N_k, F) with hidden entries on lines between visible ones.

        A channel that a sequence never shows is 0, its mean over all sequences.
        """
        frames = np.arange(self.values.shape[1], dtype=np.float64)
        return [np.nan_to_num(interpolate_channels(y, frames[: len(y)])) for y in self.arrays()]
