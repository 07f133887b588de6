"""Recordings as padded sequences, and which of them share the covariances of the filter."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.alignment.sequences import Sequences
from mocapbench.baselines.common.recordings import interpolated
from mocapbench.basics.arrays import Array

__all__ = ["Observations"]


@dataclass(frozen=True)
class Observations(Sequences):
    """K padded sequences, grouped by their masks.

    The covariances of the filter depend on what was visible so far, and not on values. Sequences
    whose masks agree as far as both go therefore share them: complete recordings of any length are
    one group.
    """

    @cached_property
    def leaders(self) -> NDArray[np.intp]:
        """(U,) the longest sequence of each group."""
        return np.asarray(np.unique(self._leader_of))

    @cached_property
    def groups(self) -> NDArray[np.intp]:
        """(K,) the group of each sequence, an index into `leaders`."""
        return np.asarray(np.searchsorted(self.leaders, self._leader_of))

    @cached_property
    def _leader_of(self) -> NDArray[np.intp]:
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

    def rows(self, index: NDArray[np.intp]) -> Self:
        """Return the sequences at ``index``, padded to the longest of them."""
        lengths = self.lengths[index]
        kept = slice(lengths.max(initial=0))
        return type(self)(self.values[index][:, kept], self.visible[index][:, kept], lengths)

    def interpolate_hidden(self) -> list[Array]:
        """Return each sequence (N_k, D) with hidden entries on lines between visible ones.

        A channel that a sequence never shows is 0, its mean over all sequences.
        """
        frames = np.arange(self.values.shape[1], dtype=np.float64)
        return [np.nan_to_num(interpolated(y, frames[: len(y)])) for y in self.arrays()]
