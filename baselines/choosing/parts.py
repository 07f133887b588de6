"""Hidden entries that are weighed together: those of one unit, in gaps of one kind.

A model that fills a channel from the others of its frame may be the best where a few channels are
hidden, and has nothing to go by where all are; one that interpolates has nothing to go by in a
channel that is hidden throughout. Where a recording has gaps of several kinds, copies of them are
held out, and weighed, apart.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.gaps import whole_gaps
from mocapbench.datasets import Mask, Recording

__all__ = ["EVERYTHING", "GAPS", "Part", "parts_of"]


@dataclass(frozen=True)
class Kind:
    """A kind of gaps.

    Parameters
    ----------
    label : str
        What names of parts of this kind end in.
    entries : callable
        From what is hidden (N, D) to the entries that such gaps may have, visible ones included.
    """

    label: str
    entries: Callable[[Mask], Mask]


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


_ANY = Kind("", _any)
_FRAMES = Kind(", whole frames", _whole_frames)
_LOST = Kind(", whole channels", _whole_channels)
_NOT_LOST = Kind("", _not_whole_channels)


@dataclass(frozen=True, eq=False)
class Part:
    """Channels, and gaps of all kinds or of one.

    Parameters
    ----------
    channels : ndarray of bool, shape (D,), or slice
    kind : Kind
    """

    channels: NDArray[np.bool_] | slice
    kind: Kind = _ANY

    @property
    def widely(self) -> Part:
        """Gaps of all kinds in its channels, for a part of which nothing can be held out."""
        return replace(self, kind=_ANY)

    def entries(self, hidden: Mask) -> Mask:
        """Return the entries (N, D) of the part, if ``hidden`` is what is hidden."""
        entries = np.zeros_like(hidden)
        entries[:, self.channels] = self.kind.entries(hidden)[:, self.channels]
        return entries


EVERYTHING = Part(slice(None))
GAPS = Part(slice(None), _NOT_LOST)
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
    kinds = [_NOT_LOST if both else _ANY]
    if whole.any() and (gaps & ~whole).any():
        kinds.append(_FRAMES)
    if both:
        kinds.append(_LOST)
    return {
        f"{unit}{kind.label}": Part(units == unit, kind)
        for unit in np.unique(units)
        for kind in kinds
        if kind != _LOST or lost[:, units == unit].any()
    }
