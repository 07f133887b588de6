"""Gaps: runs of hidden entries, and those that occur together.

Before a marker is first seen and after it is last seen, nobody knows where it was, or whether it
was there: these are the ends of a recording.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from mocapbench.datasets import Mask

__all__ = ["Episode", "Gap", "count_entries", "find_gaps", "group_gaps", "mask_ends", "mask_gaps"]


@dataclass(frozen=True, order=True)
class Gap:
    """Channels that are hidden over the same frames.

    Parameters
    ----------
    start, stop : int
        The frames [start, stop), 0-based.
    channels : tuple of int
        Indices, ascending.
    """

    start: int
    stop: int
    channels: tuple[int, ...]

    def __len__(self) -> int:
        return self.stop - self.start

    def move(self, frames: int) -> Self:
        """Return the gap so many frames later."""
        return replace(self, start=self.start + frames, stop=self.stop + frames)


@dataclass(frozen=True)
class Episode:
    """Gaps that overlap in time, directly or through others.

    Parameters
    ----------
    gaps : tuple of Gap
        At least one.
    """

    gaps: tuple[Gap, ...]

    @property
    def start(self) -> int:
        """The first frame with a hidden entry."""
        return min(gap.start for gap in self.gaps)

    @property
    def stop(self) -> int:
        """One more than the last frame with a hidden entry."""
        return max(gap.stop for gap in self.gaps)

    def __len__(self) -> int:
        return self.stop - self.start

    @property
    def n_entries(self) -> int:
        """The number of hidden entries."""
        return count_entries(self.gaps)

    def move(self, frames: int) -> Self:
        """Return the episode so many frames later."""
        return replace(self, gaps=tuple(gap.move(frames) for gap in self.gaps))

    def shorten(self, share: float) -> Self:
        """Return the episode with all its times, from its start on, cut to a share of them."""
        start = self.start

        def at(frame: int) -> int:
            return start + int((frame - start) * share)

        gaps = (
            replace(g, start=at(g.start), stop=max(at(g.stop), at(g.start) + 1)) for g in self.gaps
        )
        return replace(self, gaps=tuple(gaps))


def count_entries(gaps: Iterable[Gap]) -> int:
    """Return the number of hidden entries of gaps."""
    return sum(len(gap) * len(gap.channels) for gap in gaps)


def find_gaps(hidden: Mask) -> tuple[Gap, ...]:
    """Return the gaps of a mask (N, D), by their first frame; together they are the mask."""
    alike: dict[tuple[int, int], list[int]] = defaultdict(list)
    # All channels at once: a recording may have hundreds, of which few have gaps.
    is_edge = np.zeros((len(hidden) + 1, hidden.shape[1]), dtype=bool)
    is_edge[:-1] = hidden
    is_edge[1:] ^= hidden
    frames, channels = np.divmod(np.flatnonzero(is_edge), hidden.shape[1])
    by_channel = np.argsort(channels, kind="stable")
    bounds = frames[by_channel].reshape(-1, 2).tolist()
    for channel, (start, stop) in zip(channels[by_channel][::2].tolist(), bounds, strict=True):
        alike[start, stop].append(channel)
    return tuple(Gap(start, stop, tuple(alike[start, stop])) for start, stop in sorted(alike))


def mask_gaps(gaps: Iterable[Gap], shape: tuple[int, ...]) -> Mask:
    """Return the mask (N, D) of the entries in any of the gaps."""
    hidden = np.zeros(shape, dtype=bool)
    for gap in gaps:
        hidden[gap.start : gap.stop, list(gap.channels)] = True
    return hidden


def mask_ends(visible: Mask) -> Mask:
    """Return the entries (N, D) before the first visible one of their channel or after the last.

    A channel of which nothing is visible has no ends.
    """
    first, last = visible.argmax(axis=0), len(visible) - 1 - visible[::-1].argmax(axis=0)
    frames = np.arange(len(visible))[:, np.newaxis]
    ends: Mask = visible.any(axis=0) & ((frames < first) | (frames > last))
    return ends


def group_gaps(gaps: Sequence[Gap]) -> tuple[Episode, ...]:
    """Return the gaps grouped into episodes, by their first frame."""
    groups: list[list[Gap]] = []
    reach = 0
    for gap in sorted(gaps, key=lambda gap: (gap.start, gap.stop)):
        if not groups or gap.start >= reach:
            groups.append([])
        groups[-1].append(gap)
        reach = max(reach, gap.stop)
    return tuple(Episode(tuple(group)) for group in groups)
