"""Recordings on one time grid, and the patterns in which they are visible.

A *pattern* is a set of replicates with the same visible entries. Exact inference needs only the
mean curve of a pattern and the deviations from it, so its cost hardly grows with the number of
replicates (docs/mathematics/inference.md, section 2).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array, Index
from mocapbench.datasets import Recording

__all__ = ["Replicates"]


@dataclass(frozen=True, eq=False)
class Replicates:
    """R replicates of D outputs on the union of their visible times.

    Parameters
    ----------
    times : ndarray of shape (N,)
        All times at which something is visible.
    data : ndarray of shape (R, D, N)
        The values, 0 where hidden.
    observed : ndarray of bool, shape (R, D, N)
        Which entries are visible.
    """

    times: Array
    data: Array
    observed: NDArray[np.bool_]

    @classmethod
    def align(cls, recordings: Sequence[Recording]) -> Self:
        """Put recordings with the same channels on the union of their visible times."""
        seen = [recording.visible.any(axis=1) for recording in recordings]
        times = np.unique(
            np.concatenate([rec.times[rows] for rec, rows in zip(recordings, seen, strict=True)])
        )
        values = np.full((len(recordings), len(recordings[0].channels), len(times)), np.nan)
        for replicate, recording, rows in zip(values, recordings, seen, strict=True):
            columns = np.searchsorted(times, recording.times[rows])
            replicate[:, columns] = recording.values[rows].T
        observed = ~np.isnan(values)
        return cls(times, np.where(observed, values, 0.0), observed)

    def showing(self, number: int, recording: Recording) -> Self:
        """Return the replicates where one of them shows no more than a recording does.

        Parameters
        ----------
        number : int
            That of the replicate.
        recording : Recording
            With the same channels; visible where the replicate is, or at fewer entries.
        """
        rows = recording.visible.any(axis=1)
        shown = np.zeros_like(self.observed[number])
        shown[:, np.searchsorted(self.times, recording.times[rows])] = recording.visible[rows].T
        observed = self.observed.copy()
        observed[number] = shown
        return replace(self, data=np.where(observed, self.data, 0.0), observed=observed)

    @cached_property
    def patterns(self) -> tuple[tuple[Index, NDArray[np.bool_]], ...]:
        """The patterns, in order of first appearance, of replicates with a visible entry.

        Each is the indices (R_p,) of its replicates, and which of their entries (D, N) are visible.
        """
        groups: dict[bytes, list[int]] = {}
        for r, visible in enumerate(self.observed):
            groups.setdefault(visible.tobytes(), []).append(r)
        return tuple(
            (np.array(members), self.observed[members[0]])
            for members in groups.values()
            if self.observed[members[0]].any()
        )
