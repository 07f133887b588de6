"""What is asked for: which entries of a recording are to be filled."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mocapbench.benchmark.errors import UsageError, first_of
from mocapbench.benchmark.filling.channels import chosen
from mocapbench.benchmark.filling.gaps import Gap, gaps_of, mask_of
from mocapbench.benchmark.filling.markers import is_unlabelled, markers_of
from mocapbench.benchmark.filling.zeros import zeros_caution
from mocapbench.datasets import Mask, Recording, unwrapped
from mocapbench.reports import counted

__all__ = ["Entries", "Request", "select"]


@dataclass(frozen=True)
class Entries:
    """Which entries the user names; by default every hidden one.

    Parameters
    ----------
    frames : tuple of int or None
        Frames [first, stop), 0-based, which are filled whether the file has values there or not.
    channels : str or None
        A regular expression that matches the whole name of a channel. Without one, all channels
        but those of unlabelled markers are meant.
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
    unlabelled : tuple of str
        Channels of unlabelled markers that have hidden entries, and that nobody named.
    """

    given: Recording
    target: Mask
    left_open: tuple[Gap, ...]
    unlabelled: tuple[str, ...] = ()

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
    unlabelled = _unlabelled(recording, named)
    if not named.any():
        raise UsageError(f"{recording.name}: {_no_gap(recording, entries, unlabelled)}")
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
    return Request(given, named & ~mask_of(open_gaps, named.shape), open_gaps, unlabelled)


def _named(recording: Recording, entries: Entries) -> Mask:
    """Return the entries (N, D) that are named: given frames, or else what is hidden."""
    rows = ~recording.visible if entries.frames is None else _rows(recording, entries.frames)
    return rows & chosen(recording, entries.channels)


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


def _seconds(recording: Recording, gap: Gap) -> float:
    """Return how long a gap is: its frames times the mean distance of frames within and beside."""
    first, last = max(gap.start - 1, 0), min(gap.stop, len(recording.times) - 1)
    span = float(recording.times[last] - recording.times[first])
    return len(gap) * span / max(last - first, 1)


def _unlabelled(recording: Recording, named: Mask) -> tuple[str, ...]:
    """Return the channels of unlabelled markers that stay incomplete."""
    incomplete = ~recording.visible.all(axis=0) & ~named.any(axis=0)
    names = np.array(recording.channels)[incomplete].tolist()
    return tuple(name for name in names if is_unlabelled(name))


def _no_gap(recording: Recording, entries: Entries, unlabelled: Sequence[str]) -> str:
    if unlabelled and entries.channels is None:
        return (
            "expected a gap in a labelled marker, got hidden entries of "
            f"{counted(len(markers_of(unlabelled)), 'unlabelled marker')} only "
            f"({first_of(markers_of(unlabelled), 3)}); --channels '.*' fills all channels"
        )
    which = "entries" if entries.channels is None else f"entries of {entries.channels!r}"
    advice = "name what to fill with --frames, such as 120:180"
    hints = (f"expected a gap, got all {which} visible; {advice}", zeros_caution(recording))
    return ". ".join(filter(None, hints)).rstrip(".")
