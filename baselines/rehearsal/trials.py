"""Trials: more of a recording is hidden, like its gaps, where the truth is visible.

A trial hides copies of the gaps elsewhere: of the same lengths, in the same channels; those of gaps
in all channels hide whole frames where there is room. The real gaps stay hidden. Places are spread
evenly over the visible frames and draw no random numbers, so that a recording has the same trials
wherever it is filled. A gap that reaches an end of the recording has visible frames on one side
only, and so have its copies: they hide the first frames that are visible, or the last ones.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation

from mocapbench.basics.gaps import (
    MOST_HIDDEN,
    distances,
    free_starts,
    hidden_together,
    runs,
    whole_gaps,
)
from mocapbench.datasets import Mask, Recording

__all__ = [
    "N_TRIALS",
    "Places",
    "copies",
    "copies_or_islands",
    "halved",
    "long_copies",
    "remoteness",
    "spread_evenly",
    "trial_masks",
]

Frames = NDArray[np.intp]
Places = Callable[[NDArray[np.bool_], Frames, float], Iterator[Frames]]
"""From the frames that are not free (N,), a gap and a place, what a trial may hide instead.

It yields frames near that place (0 to 1) of the recording, those to be preferred first.
"""

N_TRIALS = 3
"""Trials of a recording."""
_LEAST_LEFT = 2
"""Frames that stay visible in a trial: one tells nothing of how far a channel goes."""
_SHARES = (1.0, 0.5, 0.25, 0.125, 0.0625)
"""By which a gap is shortened that fits nowhere."""
_GOLDEN = (np.sqrt(5.0) - 1.0) / 2.0
"""Successive multiples of it, modulo 1, are spread evenly."""


def copies(blocked: NDArray[np.bool_], gap: Frames, place: float) -> Iterator[Frames]:
    """Yield a copy of a gap, and shorter ones in case it fits nowhere."""
    starts_of = _outer_starts if _at_an_end(blocked, gap) else free_starts
    for share in _SHARES:
        n_hidden = max(round(share * len(gap)), 1)
        starts = starts_of(blocked, n_hidden)
        if len(starts):
            yield starts[int(place * len(starts))] + np.arange(n_hidden)


def long_copies(blocked: NDArray[np.bool_], gap: Frames, place: float) -> Iterator[Frames]:
    """Yield the `copies` of a gap of which some frame has no visible neighbour."""
    yield from (frames for frames in copies(blocked, gap, place) if len(frames) > 2)


def copies_or_islands(blocked: NDArray[np.bool_], gap: Frames, place: float) -> Iterator[Frames]:
    """Yield the `copies` of a gap, none of a single frame; then visible frames between gaps.

    One frame between visible ones tells little about a longer gap. Where frames are visible here
    and there, hiding those between two gaps makes one of both: longer than the gaps are, but like
    them.
    """
    shortest = min(len(gap), 2)
    yield from (frames for frames in copies(blocked, gap, place) if len(frames) >= shortest)
    islands = runs(~blocked)
    between = islands[:: max(len(islands) - 1, 1)] if _at_an_end(blocked, gap) else islands[1:-1]
    if between:
        yield between[int(place * len(between))]


def trial_masks(recording: Recording, places: Places = copies) -> list[Mask]:
    """Return what each trial hides besides the gaps: masks (N, D), True where visible entries go.

    There are fewer than `N_TRIALS` where gaps are too many or too long to have a copy, or where
    trials would be alike, and none without a gap.

    Parameters
    ----------
    recording : Recording
    places : callable
        What a trial may hide in place of a gap.
    """
    hidden = ~recording.visible
    return spread_evenly(lambda place: _trial(hidden, places, place))


def spread_evenly(trial: Callable[[float], Mask]) -> list[Mask]:
    """Return trials (N, D) at places (0 to 1) that are spread evenly, without any that are alike.

    Parameters
    ----------
    trial : callable
        From a place to what the trial there hides.
    """
    masks = [trial((n + 0.5) / N_TRIALS) for n in range(N_TRIALS)]
    unlike = {mask.tobytes(): mask for mask in masks}
    return [mask for mask in unlike.values() if mask.any()]


def halved(hidden: Mask, trial: Mask) -> Mask:
    """Return a trial (N, D) half as long: at the side where it borders on a gap, or in the middle.

    A trial of a single frame stays as it is.
    """
    shorter = np.zeros_like(trial)
    for channel, column in enumerate(trial.T):
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


def _half(hidden: NDArray[np.bool_], frames: Frames) -> Frames:
    length = max(len(frames) // 2, 1)
    beside = np.pad(hidden, 1, constant_values=True)
    if beside[frames[0]]:
        return frames[:length]
    if beside[frames[-1] + 2]:
        return frames[-length:]
    first = (len(frames) - length) // 2
    return frames[first : first + length]


def _trial(hidden: Mask, places: Places, place: float) -> Mask:
    """Return what a trial hides: whole frames, then in channels that are hidden together."""
    mask = np.zeros_like(hidden)
    whole = dict(_whole(hidden, places, place))
    for frames in whole.values():
        mask[np.ix_(frames, ~hidden.all(axis=0))] = True
    for columns in hidden_together(hidden):
        gaps = [gap for gap in runs(hidden[:, columns[0]]) if (gap[0], gap[-1]) not in whole]
        taken = mask[:, columns[0]]
        blocked = np.asarray(hidden[:, columns[0]] | binary_dilation(taken))
        spent = int(taken.sum())
        for _, frames in _tried(blocked, spent, gaps, places, place):
            mask[np.ix_(frames, columns)] = True
    return mask


def _whole(hidden: Mask, places: Places, place: float) -> Iterator[tuple[tuple[int, int], Frames]]:
    """Yield ends and copies of gaps in all channels, in a recording that has others besides.

    Channels that are hidden throughout do not count. There is no copy unless one as long as the gap
    fits in all the others at once; then the gap is one of their channels, as any other.
    """
    gappy = hidden[:, ~hidden.all(axis=0)]
    gaps = whole_gaps(hidden)
    if not gappy[np.setdiff1d(np.arange(len(hidden)), np.concatenate([[], *gaps]))].any():
        return
    for gap, frames in _tried(np.asarray(gappy.any(axis=1)), 0, gaps, places, place):
        at_an_end = gappy[: frames[0]].all() or gappy[frames[-1] + 1 :].all()
        if len(frames) == len(gap) and at_an_end >= _at_an_end(gappy[:, 0], gap):
            yield (gap[0], gap[-1]), frames


def _tried(
    blocked: NDArray[np.bool_], spent: int, gaps: Sequence[Frames], places: Places, place: float
) -> Iterator[tuple[Frames, Frames]]:
    """Yield gaps and the frames that stand for them, the first at ``place`` (0 to 1).

    They are free of what is blocked; ``spent`` frames that were visible have been hidden before.
    """
    blocked, room = blocked.copy(), MOST_HIDDEN * np.count_nonzero(~blocked)
    taken = 0
    for gap in sorted(gaps, key=len, reverse=True):
        if taken and taken + len(gap) > room:
            continue
        free = np.count_nonzero(~blocked)
        most = min((free - spent) // 2, free - _LEAST_LEFT)
        alternatives = places(blocked, gap, place % 1.0)
        none = np.empty(0, dtype=np.intp)
        frames = next((each for each in alternatives if len(each) <= most), none)
        if len(frames):
            blocked[max(frames[0] - 1, 0) : frames[-1] + 2] = True
            taken, place = taken + len(frames), place + _GOLDEN
            yield gap, frames


def _at_an_end(blocked: NDArray[np.bool_], gap: Frames) -> bool:
    return bool(gap[0] == 0 or gap[-1] == len(blocked) - 1)


def _outer_starts(blocked: NDArray[np.bool_], length: int) -> NDArray[np.intp]:
    """Return where the first and the last free frames begin that have a free one on one side."""
    free = np.flatnonzero(~blocked)
    first, last = free[: length + 1], free[-(length + 1) :]
    starts = [run[side] for side, run in enumerate((first, last)) if _unbroken(run, length + 1)]
    return np.array(starts, dtype=np.intp)


def _unbroken(frames: NDArray[np.intp], length: int) -> bool:
    return len(frames) == length and int(np.ptp(frames)) == length - 1
