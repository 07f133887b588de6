"""What makes a filled gap doubtful, in plain words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from mocapbench.basics.words import format_count, join_names
from mocapbench.benchmark.filling.choosing.choice import Choice
from mocapbench.benchmark.filling.choosing.kinds import Kind
from mocapbench.benchmark.filling.choosing.scores import list_gaps
from mocapbench.benchmark.filling.filled_recording import FilledRecording
from mocapbench.benchmark.filling.gaps import Gap, mask_ends

__all__ = ["FEW_VISIBLE", "GapCautions", "Jump"]

Jump = tuple[int, int]
"""The channel and the frame of a jump."""

FEW_VISIBLE = 10
"""Visible frames of a channel below which nothing can be learnt from it."""
_BEYOND = 0.25
"""How far filled values may lie outside the visible ones, relative to the range of these."""


class GapCautions:
    """Cautions of the gaps of a filled recording.

    Parameters
    ----------
    filled : FilledRecording
    """

    def __init__(self, filled: FilledRecording) -> None:
        given = filled.request.given
        self._channels, self._values = given.channels, filled.recording.values
        self._learnt_elsewhere = bool(filled.request.train)
        self._longest = _find_longest_copies(filled.choice) if filled.choice else None
        self._n_visible = given.visible.sum(axis=0)
        self._at_ends = mask_ends(given.visible)
        self._least = given.values.min(axis=0, initial=np.inf, where=given.visible)
        self._most = given.values.max(axis=0, initial=-np.inf, where=given.visible)

    def list_of(self, gap: Gap, kind: Kind, jumps: Sequence[Jump]) -> Iterator[str]:
        """Yield the cautions of a gap, of a kind, with jumps at its edges."""
        yield from self._warn_of_little(gap)
        yield from self._warn_of_length(gap, kind)
        if self._at_ends[gap.start, list(gap.channels)].any():
            yield "at an end, with visible frames on one side only"
        yield from self._warn_of_range(gap)
        yield from self._warn_of_jumps(jumps)

    def _warn_of_little(self, gap: Gap) -> Iterator[str]:
        least = int(self._n_visible[list(gap.channels)].min())
        if not least:
            yield "visible nowhere in the file"
        elif least < FEW_VISIBLE and not self._learnt_elsewhere:
            yield f"only {format_count(least, 'visible frame')} to learn from"

    def _warn_of_length(self, gap: Gap, kind: Kind) -> Iterator[str]:
        if self._longest is None:
            return
        longest = self._longest.get(kind, 0)
        if not longest:
            yield "no held-out gap of its kind"
        elif longest < len(gap):
            yield f"longer than any held-out gap of its kind ({format_count(longest, 'frame')})"

    def _warn_of_range(self, gap: Gap) -> Iterator[str]:
        """Yield the channel that is filled furthest outside its visible range, if it is far."""
        channels = list(gap.channels)
        least, most = self._least[channels], self._most[channels]
        values = self._values[gap.start : gap.stop, channels]
        beyond = np.maximum(least - values.min(axis=0), values.max(axis=0) - most)
        shares = np.divide(beyond, most - least, out=np.zeros_like(beyond), where=most > least)
        worst = int(shares.argmax())
        if shares[worst] > _BEYOND:
            name = self._channels[channels[worst]]
            yield f"extrapolates {name} by {100 * shares[worst]:.0f} % of its visible range"

    def _warn_of_jumps(self, jumps: Sequence[Jump]) -> Iterator[str]:
        """Yield where a gap jumps at an edge: further than between any visible frames."""
        if jumps:
            places = [f"{self._channels[channel]} at frame {frame}" for channel, frame in jumps]
            yield f"jumps in {join_names([*dict.fromkeys(places)], len(places))}"


def _find_longest_copies(choice: Choice) -> Mapping[Kind, int]:
    """Return the length of the longest held-out gap of each kind that has any."""
    longest: dict[Kind, int] = {}
    for gap in list_gaps(choice.hold_outs):
        longest[gap.kind] = max(longest.get(gap.kind, 0), len(gap.copy))
    return longest
