"""Hidden entries that are weighed together: those of one unit, in gaps of one kind.

A model that fills a channel from the others of its frame may be the best where a few channels are
hidden, and has nothing to go by where all are. Where a recording has gaps of both kinds, they are
rehearsed, and weighed, apart.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.gaps import whole_gaps
from mocapbench.datasets import Mask, Recording

__all__ = ["EVERYTHING", "Part", "parts_of"]


@dataclass(frozen=True, eq=False)
class Part:
    """Channels, and all frames or those of gaps in all channels.

    Parameters
    ----------
    channels : ndarray of bool, shape (D,), or slice
    only_whole : bool
        Whether it has only frames of gaps in all channels.
    """

    channels: NDArray[np.bool_] | slice
    only_whole: bool = False

    @property
    def widely(self) -> Part:
        """All frames of its channels, which stand in for a part that no trial has room for."""
        return replace(self, only_whole=False)

    def entries(self, hidden: Mask) -> Mask:
        """Return the entries (N, D) of the part, if ``hidden`` is what is hidden."""
        entries = np.zeros(hidden.shape, dtype=bool)
        entries[:, self.channels] = (_in_whole_gaps(hidden) | (not self.only_whole))[:, None]
        return entries


EVERYTHING = Part(slice(None))


def parts_of(recording: Recording) -> Mapping[str, Part]:
    """Return the parts of a recording by name; an entry belongs to the last one that has it.

    Each unit is a part. Where a recording has gaps in all channels and others, those in all
    channels are parts of their own, since they are harder. What is rehearsed of them counts for the
    other gaps, too, but not the other way round.
    """
    units, hidden = np.array(recording.units), ~recording.visible
    whole = _in_whole_gaps(hidden)
    mixed = bool(whole.any() and hidden[~whole].any())
    parts: dict[str, Part] = {}
    for unit in np.unique(units):
        parts[str(unit)] = Part(units == unit)
        if mixed:
            parts[f"{unit}, whole frames"] = Part(units == unit, only_whole=True)
    return parts


def _in_whole_gaps(hidden: Mask) -> NDArray[np.bool_]:
    frames = np.zeros(len(hidden), dtype=bool)
    for gap in whole_gaps(hidden):
        frames[gap] = True
    return frames
