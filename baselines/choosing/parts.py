"""Hidden entries that are weighed together: those of one unit, in gaps of one kind.

A model that fills a channel from the others of its frame may be the best where a few channels are
hidden, and has nothing to go by where all are. Where a recording has gaps of both kinds, they are
rehearsed, and weighed, apart.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.gaps import whole_gaps
from mocapbench.datasets import Mask, Recording

__all__ = ["EVERYTHING", "Part", "parts_of"]


@dataclass(frozen=True, eq=False)
class Part:
    """Channels, and the frames of gaps in all channels, the others, or both.

    Parameters
    ----------
    channels : ndarray of bool, shape (D,), or slice
    whole : tuple of bool
        Whether the frames are those of gaps in all channels.
    """

    channels: NDArray[np.bool_] | slice
    whole: tuple[bool, ...] = (True, False)

    def entries(self, hidden: Mask) -> Mask:
        """Return the entries (N, D) of the part, if ``hidden`` is what is hidden."""
        entries = np.zeros(hidden.shape, dtype=bool)
        entries[:, self.channels] = np.isin(_in_whole_gaps(hidden), self.whole)[:, None]
        return entries

    def of(self, values: NDArray[Any], hidden: Mask) -> NDArray[Any]:
        """Return the values (N, D) at the entries of the part, one after another."""
        return np.asarray(values[self.entries(hidden)])


EVERYTHING = Part(slice(None))


def parts_of(recording: Recording) -> Mapping[str, Sequence[Part]]:
    """Return the parts of a recording by name, each followed by what stands in for it.

    A part of which nothing is rehearsed takes the weights of the next. Gaps in all channels, which
    are the harder ones, stand in for others, but not the other way round.
    """
    units, hidden = np.array(recording.units), ~recording.visible
    whole = _in_whole_gaps(hidden)
    mixed = bool(whole.any() and hidden[~whole].any())
    parts: dict[str, Sequence[Part]] = {}
    for unit in np.unique(units):
        every = Part(units == unit)
        parts[str(unit)] = [Part(every.channels, (False,)), every] if mixed else [every]
        if mixed:
            parts[f"{unit}, whole frames"] = [Part(every.channels, (True,))]
    return parts


def _in_whole_gaps(hidden: Mask) -> NDArray[np.bool_]:
    frames = np.zeros(len(hidden), dtype=bool)
    for gap in whole_gaps(hidden):
        frames[gap] = True
    return frames
