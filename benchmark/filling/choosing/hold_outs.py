"""Hold-outs: copies of the real gaps, hidden where the recording is visible.

A hold-out takes the recording with its real gaps, and hides copies of them elsewhere: of the same
lengths, in the same channels, those together that occur together. Gaps at the recording's ends,
which have frames on one side only, are copied where there are no others; then the hold-out begins
or ends with the copy.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.basics.arrays import Array, Index
from mocapbench.benchmark.filling.choosing.layout import EpisodeLayout, EpisodeQueue
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.filling.gaps import Episode, Gap, find_gaps, group_gaps
from mocapbench.datasets import Mask

__all__ = ["HoldOut", "has_room", "make_hold_outs"]

MOST_HOLD_OUTS, ENOUGH_GAPS = 24, 48
"""Hold-outs are made until there are so many of them, or so many held-out gaps."""
FEWEST_HOLD_OUTS, MOST_ENTRIES = 3, 40_000_000
"""Of long recordings there are fewer: no more than have so many entries (320 MB) in all."""
_REPEATS = 10
"""Hold-outs that may repeat others before no more are made."""


@dataclass(frozen=True, eq=False)
class HoldOut:
    """A problem whose solution is known.

    Parameters
    ----------
    problem : GapProblem
        The recording, or a part of it that begins or ends with a gap, with more hidden.
    truth : ndarray of shape (M,)
        The values of the wanted entries, in the order of ``np.nonzero(problem.target)``.
    entries : tuple of ndarray of int
        Which of the wanted entries (M,) each held-out gap has; they are scored together.
    copies : tuple of Episode
        The held-out gaps, at their frames in the whole recording.
    originals : tuple of Episode
        The real gaps of which these are copies.
    share : float
        The length of the shortest held-out gap relative to the real one; 1 if none was shortened.
    """

    problem: GapProblem
    truth: Array
    entries: tuple[Index, ...]
    copies: tuple[Episode, ...]
    originals: tuple[Episode, ...]
    share: float


def make_hold_outs(problem: GapProblem, rng: np.random.Generator) -> list[HoldOut]:
    """Return hold-outs of the gaps of a problem; none if there is no room for any.

    No two are alike: some that repeat others are made again, and then no more.
    """
    hold_outs: list[HoldOut] = []
    made: set[tuple[float, bytes]] = set()
    repeats = 0
    used = np.zeros(len(problem.given.times), dtype=bool)
    queue = EpisodeQueue(_group_interior_gaps(problem), rng)
    most = min(MOST_HOLD_OUTS, max(FEWEST_HOLD_OUTS, MOST_ENTRIES // problem.target.size))
    while len(hold_outs) < most and sum(len(one.copies) for one in hold_outs) < ENOUGH_GAPS:
        hold_out = _make_hold_out(problem, used, queue, rng)
        if hold_out is None or repeats > _REPEATS:
            break
        # What tells hold-outs apart: where one begins, and what it hides.
        key = float(hold_out.problem.given.times[0]), hold_out.problem.target.tobytes()
        if key in made:
            repeats += 1
            continue
        made.add(key)
        hold_outs.append(hold_out)
    return hold_outs


def has_room(problem: GapProblem, rng: np.random.Generator) -> bool:
    """Return whether there is room for a hold-out of the gaps of a problem."""
    used = np.zeros(len(problem.given.times), dtype=bool)
    queue = EpisodeQueue(_group_interior_gaps(problem), rng)
    return _make_hold_out(problem, used, queue, rng) is not None


def _make_hold_out(
    problem: GapProblem, used: Mask, queue: EpisodeQueue, rng: np.random.Generator
) -> HoldOut | None:
    """Return one hold-out, and mark the frames that it hides as used."""
    layout = EpisodeLayout(~problem.given.visible, used, rng)
    if queue.n_per_hold_out:
        layout.place_between(queue)
    else:
        first, last = _find_gaps_at_the_ends(problem)
        layout.begin(first)
        layout.end(last)
    return _hide_copies(problem, layout) if layout.copies else None


def _find_gaps_at_the_ends(problem: GapProblem) -> tuple[list[Gap], list[Gap]]:
    """Return the gaps at the beginning and those at the end of the recording."""
    n_frames, gaps = len(problem.given.times), find_gaps(problem.target)
    first = [gap for gap in gaps if gap.start == 0]
    return first, [gap for gap in gaps if gap.stop == n_frames and gap.start > 0]


def _group_interior_gaps(problem: GapProblem) -> tuple[Episode, ...]:
    """Return the episodes of the gaps that are not at an end."""
    ends = {gap for gaps in _find_gaps_at_the_ends(problem) for gap in gaps}
    return group_gaps([gap for gap in find_gaps(problem.target) if gap not in ends])


def _hide_copies(problem: GapProblem, layout: EpisodeLayout) -> HoldOut:
    frames = np.arange(layout.start, layout.stop)
    recording = problem.given.frames(frames)
    owners = np.full(problem.target.shape, -1, dtype=np.int32)
    for number, episode in enumerate(layout.copies):
        for gap in episode.gaps:
            owners[gap.start : gap.stop, list(gap.channels)] = number
    owners = owners[frames]
    target = owners >= 0
    entries = (np.flatnonzero(owners[target] == number) for number in range(len(layout.copies)))
    return HoldOut(
        problem=GapProblem(recording.hide(target), target, problem.train),
        truth=recording.values[target],
        entries=tuple(entries),
        copies=tuple(layout.copies),
        originals=tuple(layout.originals),
        share=layout.share,
    )
