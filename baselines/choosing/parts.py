"""Hidden entries that are weighed together: those of one unit, in gaps of one kind.

A model that fills a channel from the others of its frame may be the best where a few channels are
hidden, and has nothing to go by where all are; one that interpolates has nothing to go by in a
channel that is hidden throughout. Where a recording has gaps of several kinds, copies of them are
held out, and weighed, apart.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.mask_runs import whole_gaps
from mocapbench.datasets import Mask, Recording

__all__ = ["EVERYTHING", "GAPS", "Part", "parts_of"]


Kind = Callable[[Mask], Mask]
"""A kind of gaps: from what is hidden (N, D) to the entries that such gaps may have, visible ones
included."""


def _any(hidden: Mask) -> Mask:
    return np.ones_like(hidden)


def _whole_frames(hidden: Mask) -> Mask:
    entries = np.zeros_like(hidden)
    for gap in whole_gaps(hidden):
        entries[gap] = True
    return entries


def _whole_channels(hidden: Mask) -> Mask:
    return np.asarray(hidden.all(axis=0) & np.ones_like(hidden))


def _not_whole_channels(hidden: Mask) -> Mask:
    return ~_whole_channels(hidden)


_LABELS: Mapping[Kind, str] = {
    _any: "",
    _not_whole_channels: "",
    _whole_frames: ", whole frames",
    _whole_channels: ", whole channels",
}
"""What names of parts of each kind end in."""


class Part:
    """Channels, and gaps of all kinds or of one.

    Parameters
    ----------
    channels : ndarray of bool, shape (D,), or slice
    kind : callable
        See `Kind`.
    """

    def __init__(self, channels: NDArray[np.bool_] | slice, kind: Kind = _any) -> None:
        self.channels = channels
        self.kind = kind

    @property
    def widely(self) -> Part:
        """Gaps of all kinds in its channels, for a part of which nothing can be held out."""
        return Part(self.channels)

    def entries(self, hidden: Mask) -> Mask:
        """Return the entries (N, D) of the part, if ``hidden`` is what is hidden."""
        entries = np.zeros_like(hidden)
        entries[:, self.channels] = self.kind(hidden)[:, self.channels]
        return entries


EVERYTHING = Part(slice(None))
GAPS = Part(slice(None), _not_whole_channels)
"""All but the channels that are hidden throughout."""


def parts_of(recording: Recording) -> Mapping[str, Part]:
    """Return the parts of a recording by name; an entry belongs to the last one that has it.

    Each unit is a part. Where a recording has gaps in all channels and others, those in all
    channels are parts of their own, since they are harder. What is held out for them counts for the
    other gaps, too, but not the other way round. Channels that are hidden throughout are parts of
    their own where there are other gaps.
    """
    units, hidden = np.array(recording.units), ~recording.visible
    lost = _whole_channels(hidden)
    whole, gaps = _whole_frames(hidden), hidden & ~lost
    both = bool(lost.any() and gaps.any())
    kinds: list[Kind] = [_not_whole_channels if both else _any]
    if whole.any() and (gaps & ~whole).any():
        kinds.append(_whole_frames)
    if both:
        kinds.append(_whole_channels)
    return {
        f"{unit}{_LABELS[kind]}": Part(units == unit, kind)
        for unit in np.unique(units)
        for kind in kinds
        if kind is not _whole_channels or lost[:, units == unit].any()
    }
