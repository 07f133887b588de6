"""Held-out gaps: copies of a recording's gaps, where the truth is visible.

A set of held-out gaps has the lengths of the real ones and lies in the same channels; copies of
gaps in all channels hide whole frames where there is room. The real gaps stay hidden. Positions are
spread evenly over the visible frames and draw no random numbers, so that a recording has the same
held-out gaps wherever it is filled. A gap that reaches an end of the recording has visible frames
on one side only, and so have its copies: they hide the first frames that are visible, or the last.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation

from mocapbench.basics.mask_runs import (
    MOST_HIDDEN,
    distances,
    free_starts,
    hidden_together,
    runs,
    whole_gaps,
)
from mocapbench.datasets import Mask, Recording

__all__ = [
    "N_SETS",
    "Alternatives",
    "copies",
    "copies_or_islands",
    "halve_gaps",
    "hold_out_channels",
    "hold_out_gaps",
    "long_copies",
    "remoteness",
]

FrameIndex = NDArray[np.intp]
Alternatives = Callable[[NDArray[np.bool_], FrameIndex, float], Iterator[FrameIndex]]
"""From the frames that are not free (N,), a gap and a position, what may be held out for the gap.

It yields frames near that position (0 to 1) of the recording, those to be preferred first.
"""

N_SETS = 3
"""Sets of held-out gaps of a recording."""
_LEAST_LEFT = 2
"""Frames that stay visible: one tells nothing of how far a channel goes."""
_SHARES = (1.0, 0.5, 0.25, 0.125, 0.0625)
"""By which a gap is shortened that fits nowhere."""
_GOLDEN = (np.sqrt(5.0) - 1.0) / 2.0
"""Successive multiples of it, modulo 1, are spread evenly."""


def copies(blocked: NDArray[np.bool_], gap: FrameIndex, position: float) -> Iterator[FrameIndex]:
    """Yield a copy of a gap, and shorter ones in case it fits nowhere."""
    starts_of = _outer_starts if _at_an_end(blocked, gap) else free_starts
    for share in _SHARES:
        n_hidden = max(round(share * len(gap)), 1)
        starts = starts_of(blocked, n_hidden)
        if len(starts):
            yield starts[int(position * len(starts))] + np.arange(n_hidden)


def long_copies(
    blocked: NDArray[np.bool_], gap: FrameIndex, position: float
) -> Iterator[FrameIndex]:
    """Yield the `copies` of a gap of which some frame has no visible neighbour."""
    yield from (frames for frames in copies(blocked, gap, position) if len(frames) > 2)


def copies_or_islands(
    blocked: NDArray[np.bool_], gap: FrameIndex, position: float
) -> Iterator[FrameIndex]:
    """Yield the `copies` of a gap, none of a single frame; then visible frames between gaps.

    One frame between visible ones tells little about a longer gap. Where frames are visible here
    and there, hiding those between two gaps makes one of both: longer than the gaps are, but like
    them.
    """
    shortest = min(len(gap), 2)
    yield from (frames for frames in copies(blocked, gap, position) if len(frames) >= shortest)
    islands = runs(~blocked)
    between = islands[:: max(len(islands) - 1, 1)] if _at_an_end(blocked, gap) else islands[1:-1]
    if between:
        yield between[int(position * len(between))]


def hold_out_gaps(recording: Recording, alternatives: Alternatives = copies) -> list[Mask]:
    """Return what each set of held-out gaps hides: masks (N, D), True where visible entries go.

    There are fewer than `N_SETS` where gaps are too many or too long to have a copy, or where sets
    would be alike, and none without a gap.

    Parameters
    ----------
    recording : Recording
    alternatives : callable
        What may be held out for a gap.
    """
    hidden = ~recording.visible
    return _spread_evenly(lambda position: _hold_out_at(position, hidden, alternatives))


def hold_out_channels(recording: Recording) -> list[Mask]:
    """Return what is held out in place of channels that are hidden throughout: masks (N, D).

    As many neighbouring channels of the same unit, but half of those visible at most, which is none
    if there is one. Their positions are spread evenly over the channels.

    Parameters
    ----------
    recording : Recording
    """
    return _spread_evenly(lambda position: _hold_out_channels_at(position, recording))


def _spread_evenly(hold_out: Callable[[float], Mask]) -> list[Mask]:
    """Return what is held out (N, D) at positions spread evenly over 0 to 1, without repetition."""
    masks = [hold_out((n + 0.5) / N_SETS) for n in range(N_SETS)]
    unlike = {mask.tobytes(): mask for mask in masks}
    return [mask for mask in unlike.values() if mask.any()]


def _hold_out_channels_at(position: float, recording: Recording) -> Mask:
    mask = np.zeros_like(recording.visible)
    lost, units = ~recording.visible.any(axis=0), np.array(recording.units)
    for unit in np.unique(units[lost]):
        shown = np.flatnonzero((units == unit) & ~lost)
        n_hidden = min(int((lost & (units == unit)).sum()), len(shown) // 2)
        first = int(position * (len(shown) - n_hidden + 1))
        mask[:, shown[first : first + n_hidden]] = True
    return mask


def halve_gaps(hidden: Mask, held_out: Mask) -> Mask:
    """Return held-out gaps (N, D) half as long: beside a real gap, or in the middle.

    A gap of a single frame stays as it is.
    """
    shorter = np.zeros_like(held_out)
    for channel, column in enumerate(held_out.T):
        for frames in runs(column):
            shorter[_half(hidden[:, channel], frames), channel] = True
    return shorter


def remoteness(hidden: Mask, within: Mask) -> NDArray[np.intp]:
    """Return for each channel (D,) the most frames between an entry and the nearest visible one.

    Parameters
    ----------
    hidden : ndarray of shape (N, D)
        What is hidden; 0 is returned for channels that are hidden throughout.
    within : ndarray of shape (N, D)
        The entries.
    """
    distance = distances(hidden)
    counted = within & np.isfinite(distance)
    return np.asarray(distance.max(axis=0, where=counted, initial=0), dtype=np.intp)


def _half(hidden: NDArray[np.bool_], frames: FrameIndex) -> FrameIndex:
    length = max(len(frames) // 2, 1)
    beside = np.pad(hidden, 1, constant_values=True)
    if beside[frames[0]]:
        return frames[:length]
    if beside[frames[-1] + 2]:
        return frames[-length:]
    first = (len(frames) - length) // 2
    return frames[first : first + length]


def _hold_out_at(position: float, hidden: Mask, alternatives: Alternatives) -> Mask:
    """Hold out whole frames, then gaps of channels that are hidden together."""
    mask = np.zeros_like(hidden)
    whole = dict(_copy_whole_frames(position, hidden, alternatives))
    for frames in whole.values():
        mask[np.ix_(frames, ~hidden.all(axis=0))] = True
    for columns in hidden_together(hidden):
        gaps = [gap for gap in runs(hidden[:, columns[0]]) if (gap[0], gap[-1]) not in whole]
        taken = mask[:, columns[0]]
        blocked = np.asarray(hidden[:, columns[0]] | binary_dilation(taken))
        spent = int(taken.sum())
        for _, frames in _copy_gaps(position, blocked, spent, gaps, alternatives):
            mask[np.ix_(frames, columns)] = True
    return mask


def _copy_whole_frames(
    position: float, hidden: Mask, alternatives: Alternatives
) -> Iterator[tuple[tuple[int, int], FrameIndex]]:
    """Yield ends and copies of gaps in all channels, in a recording that has others besides.

    Channels that are hidden throughout do not count. There is no copy unless one as long as the gap
    fits in all the others at once; then the gap is one of their channels, as any other.
    """
    gappy = hidden[:, ~hidden.all(axis=0)]
    gaps = whole_gaps(hidden)
    if not gappy[np.setdiff1d(np.arange(len(hidden)), np.concatenate([[], *gaps]))].any():
        return
    blocked = np.asarray(gappy.any(axis=1))
    for gap, frames in _copy_gaps(position, blocked, 0, gaps, alternatives):
        at_an_end = gappy[: frames[0]].all() or gappy[frames[-1] + 1 :].all()
        if len(frames) == len(gap) and at_an_end >= _at_an_end(gappy[:, 0], gap):
            yield (gap[0], gap[-1]), frames


def _copy_gaps(
    position: float,
    blocked: NDArray[np.bool_],
    spent: int,
    gaps: Sequence[FrameIndex],
    alternatives: Alternatives,
) -> Iterator[tuple[FrameIndex, FrameIndex]]:
    """Yield gaps and the frames held out for them, the first at a position from 0 to 1.

    They are free of what is blocked; ``spent`` frames that were visible have been hidden before.
    """
    blocked, room = blocked.copy(), MOST_HIDDEN * np.count_nonzero(~blocked)
    taken = 0
    for gap in sorted(gaps, key=len, reverse=True):
        if taken and taken + len(gap) > room:
            continue
        free = np.count_nonzero(~blocked)
        most = min((free - spent) // 2, free - _LEAST_LEFT)
        candidates = alternatives(blocked, gap, position % 1.0)
        none = np.empty(0, dtype=np.intp)
        frames = next((each for each in candidates if len(each) <= most), none)
        if len(frames):
            blocked[max(frames[0] - 1, 0) : frames[-1] + 2] = True
            taken, position = taken + len(frames), position + _GOLDEN
            yield gap, frames


def _at_an_end(blocked: NDArray[np.bool_], gap: FrameIndex) -> bool:
    return bool(gap[0] == 0 or gap[-1] == len(blocked) - 1)


def _outer_starts(blocked: NDArray[np.bool_], length: int) -> NDArray[np.intp]:
    """Return where the first and the last free frames begin that have a free one on one side."""
    free = np.flatnonzero(~blocked)
    first, last = free[: length + 1], free[-(length + 1) :]
    starts = [run[side] for side, run in enumerate((first, last)) if _is_unbroken(run, length + 1)]
    return np.array(starts, dtype=np.intp)


def _is_unbroken(frames: NDArray[np.intp], length: int) -> bool:
    return len(frames) == length and int(np.ptp(frames)) == length - 1
