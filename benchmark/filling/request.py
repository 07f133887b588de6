"""What is asked for: which entries of a recording are to be filled."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.gaps import Gap, gaps_of, mask_of
from mocapbench.datasets import Mask, Recording, unwrapped

__all__ = ["Entries", "Request", "select"]


@dataclass(frozen=True)
class Entries:
    """Which entries the user names; by default every hidden one.

    Parameters
    ----------
    frames : tuple of int or None
        Frames [first, stop), 0-based, which are filled whether the file has values there or not.
    channels : str or None
        A regular expression that matches the whole name of a channel.
    max_gap : float or None
        Seconds; longer gaps stay open.
    """

    frames: tuple[int, int] | None = None
    channels: str | None = None
    max_gap: float | None = None


@dataclass(frozen=True, eq=False)
class Request:
    """A recording, and which of its entries to fill.

    Parameters
    ----------
    given : Recording
        N frames of D channels, of which all entries to fill are hidden.
    target : ndarray of bool of shape (N, D)
        The entries to fill.
    left_open : tuple of Gap
        Gaps that were asked for, and are longer than allowed.
    """

    given: Recording
    target: Mask
    left_open: tuple[Gap, ...]

    @property
    def gaps(self) -> tuple[Gap, ...]:
        """The gaps to fill."""
        return gaps_of(self.target)


def select(recording: Recording, entries: Entries) -> Request:
    """Return the request of filling the entries named.

    Raises
    ------
    UsageError
        If frames or channels are not in the recording, nothing is to be filled, or nothing is
        visible.
    """
    named = _named(recording, entries)
    if not named.any():
        raise UsageError(
            f"{recording.name}: expected a gap, got all {_described(entries)} visible; "
            "name what to fill with --frames, such as 120:180"
        )
    given = unwrapped(recording.hide(named))
    if not given.visible.any():
        raise UsageError(
            f"{recording.name}: expected visible entries to fill the others from, got none; "
            "name fewer frames or channels"
        )
    gaps = gaps_of(named)
    open_gaps = tuple(gap for gap in gaps if _seconds(recording, gap) > (entries.max_gap or np.inf))
    if len(open_gaps) == len(gaps):
        shortest = min(_seconds(recording, gap) for gap in gaps)
        raise UsageError(
            f"{recording.name}: expected a gap of {entries.max_gap:g} s or less, got "
            f"{len(gaps)} of {shortest:.3g} s or more; raise --max-gap"
        )
    return Request(given, named & ~mask_of(open_gaps, named.shape), open_gaps)


def _named(recording: Recording, entries: Entries) -> Mask:
    """Return the entries (N, D) that are named: given frames, or else what is hidden."""
    rows = ~recording.visible if entries.frames is None else _rows(recording, entries.frames)
    return rows & _columns(recording, entries.channels)


def _rows(recording: Recording, frames: tuple[int, int]) -> Mask:
    first, stop = frames
    n_frames = len(recording.times)
    if not 0 <= first < stop <= n_frames:
        raise UsageError(
            f"{recording.name}: expected --frames within 0:{n_frames}, the first before the last, "
            f"got {first}:{stop}"
        )
    rows = np.zeros(recording.values.shape, dtype=bool)
    rows[first:stop] = True
    return rows


def _columns(recording: Recording, pattern: str | None) -> Mask:
    try:
        matches = [re.fullmatch(pattern or ".*", name) is not None for name in recording.channels]
    except re.error as error:
        raise UsageError(
            f"--channels: expected a regular expression, got {pattern!r} ({error}); "
            "write such as 'lfemur.*'"
        ) from error
    if not any(matches):
        some = ", ".join(recording.channels[:5])
        raise UsageError(
            f"{recording.name}: expected --channels to match a channel, got {pattern!r}; "
            f"its {len(recording.channels)} channels begin with {some}; "
            "the pattern must match a whole name, such as 'lfemur.*'"
        )
    return np.array(matches)


def _seconds(recording: Recording, gap: Gap) -> float:
    """Return how long a gap is: its frames times the mean distance of frames within and beside."""
    first, last = max(gap.start - 1, 0), min(gap.stop, len(recording.times) - 1)
    span = float(recording.times[last] - recording.times[first])
    return len(gap) * span / max(last - first, 1)


def _described(entries: Entries) -> str:
    return "entries" if entries.channels is None else f"entries of {entries.channels!r}"
