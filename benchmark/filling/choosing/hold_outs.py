"""Hold-outs: copies of the real gaps, hidden where the recording is visible.

A hold-out takes the recording with its real gaps, and hides copies of them elsewhere: of the same
lengths, in the same channels, those together that occur together. Gaps at the recording's ends,
which have frames on one side only, are copied where there are no others; then the hold-out begins
or ends with the copy. Of a long recording, each hold-out is another excerpt: what a model costs
there does not grow with the recording, so that the dearest are compared, too.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from mocapbench.basics.arrays import Array, Index
from mocapbench.benchmark.filling.choosing.kinds import Kind, tell_kinds
from mocapbench.benchmark.filling.choosing.layout import EpisodeLayout, EpisodeQueue
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.filling.gaps import Episode, Gap, find_gaps, group_gaps

__all__ = ["EXCERPT", "HeldOutGap", "HoldOut", "has_room", "make_hold_outs"]

MOST_HOLD_OUTS, ENOUGH_GAPS = 24, 24
"""Hold-outs are made until there are so many, or so many held-out gaps of each kind."""
FEWEST_HOLD_OUTS, MOST_ENTRIES = 3, 40_000_000
"""Of long recordings there are fewer: no more than have so many entries (320 MB) in all."""
EXCERPT, _BESIDE_GAPS = 3000, 10
"""Frames of an excerpt: so many, or so many times as many as the longest gap has.

Models that are fitted anew to each part of a long recording have parts of about as many."""
_REPEATS = 10
"""Hold-outs that may repeat others before no more are made."""


class HeldOutGap(NamedTuple):
    """A copy of a gap in the channels of one unit."""

    kind: Kind
    """That of the original."""
    copy: Gap
    """Which frames and channels are hidden, by their numbers in the whole recording."""
    original: Gap
    """The real gap."""
    entries: Index
    """Which of the wanted entries (M,) of the hold-out it has; they are scored together."""


@dataclass(frozen=True, eq=False)
class HoldOut:
    """A problem whose solution is known.

    Parameters
    ----------
    problem : GapProblem
        The recording, or a part of it that begins or ends with a gap, with more hidden.
    truth : ndarray of shape (M,)
        The values of the wanted entries, in the order of ``np.nonzero(problem.target)``.
    gaps : tuple of HeldOutGap
        Together they have all wanted entries.
    """

    problem: GapProblem
    truth: Array
    gaps: tuple[HeldOutGap, ...]


def make_hold_outs(problem: GapProblem, rng: np.random.Generator) -> list[HoldOut]:
    """Return hold-outs of the gaps of a problem; none if there is no room for any.

    No two are alike: some that repeat others are made again, and then no more.
    """
    hold_outs: list[HoldOut] = []
    made: set[tuple[float, bytes]] = set()
    repeats, maker = 0, _Maker(problem, rng)
    while len(hold_outs) < maker.most and not _are_enough(hold_outs, maker.n_kinds):
        hold_out = maker.make()
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
    return _Maker(problem, rng).make() is not None


def _are_enough(hold_outs: Sequence[HoldOut], n_kinds: int) -> bool:
    """Return whether there are enough held-out gaps of each kind."""
    counts = Counter(gap.kind for one in hold_outs for gap in one.gaps)
    return len(counts) == n_kinds and min(counts.values()) >= ENOUGH_GAPS


class _Maker:
    """Makes hold-outs of a problem, which avoid each other's frames as far as there are others.

    Parameters
    ----------
    problem : GapProblem
    rng : numpy.random.Generator
    """

    def __init__(self, problem: GapProblem, rng: np.random.Generator) -> None:
        self._problem, self._rng = problem, rng
        self._kinds = tell_kinds(problem)
        self._used = np.zeros(len(problem.given.times), dtype=bool)
        self._queue = EpisodeQueue(self._group_by_kind(), rng)
        excerpts = _cut_excerpts(problem)
        self._excerpts = deque(excerpts[number] for number in rng.permutation(len(excerpts)))
        self.n_kinds = len({kind for kinds in self._kinds.values() for kind in kinds})
        n_entries = problem.target.size // len(excerpts)
        self.most = min(MOST_HOLD_OUTS, max(FEWEST_HOLD_OUTS, MOST_ENTRIES // n_entries))

    def make(self) -> HoldOut | None:
        """Return one more hold-out; None if there is no room."""
        whole = 0, len(self._used)  # where no excerpt has room; of a short recording the only one
        for start, stop in dict.fromkeys((*self._excerpts, whole)):
            layout = EpisodeLayout(~self._problem.given.visible, self._used, self._rng)
            layout.confine(start, stop)
            self._place_copies(layout)
            self._excerpts.rotate(-1)
            if layout.copies:
                return self._hide_copies(layout)
        return None

    def _place_copies(self, layout: EpisodeLayout) -> None:
        if self._queue:
            layout.place_between(self._queue)
        else:
            first, last = _find_gaps_at_the_ends(self._problem)
            layout.begin(first)
            layout.end(last)

    def _group_by_kind(self) -> list[list[Episode]]:
        """Return the episodes of the gaps that are not at an end, by the kind of the longest."""
        n_frames, gaps = len(self._problem.given.times), find_gaps(self._problem.target)
        groups: dict[Kind, list[Episode]] = {}
        for episode in group_gaps([g for g in gaps if g.start > 0 and g.stop < n_frames]):
            kind = min(self._kinds[max(episode.gaps, key=len)])
            groups.setdefault(kind, []).append(episode)
        return [groups[kind] for kind in sorted(groups)]

    def _hide_copies(self, layout: EpisodeLayout) -> HoldOut:
        problem, frames = self._problem, np.arange(layout.start, layout.stop)
        recording = problem.given.frames(frames)
        owners = np.full(problem.target.shape, -1, dtype=np.int32)
        gaps = [*self._list_held_out(layout)]
        for number, (_, copy, _) in enumerate(gaps):
            owners[copy.start : copy.stop, list(copy.channels)] = number
        owners = owners[frames]
        target = owners >= 0
        held_out = (
            HeldOutGap(*gap, np.flatnonzero(owners[target] == number))
            for number, gap in enumerate(gaps)
        )
        hidden = GapProblem(recording.hide(target), target, problem.train)
        return HoldOut(hidden, recording.values[target], tuple(held_out))

    def _list_held_out(self, layout: EpisodeLayout) -> Iterator[tuple[Kind, Gap, Gap]]:
        """Yield the kinds of the copied gaps, each with the copy in its channels and the gap."""
        for copy, original in layout.copies:
            for kind, channels in self._kinds[original].items():
                yield kind, replace(copy, channels=channels), replace(original, channels=channels)


def _cut_excerpts(problem: GapProblem) -> list[tuple[int, int]]:
    """Return the first frame of each excerpt and the one after its last, all about as long."""
    longest = max(map(len, find_gaps(problem.target)), default=0)
    n_frames = len(problem.given.times)
    n = max(n_frames // max(EXCERPT, _BESIDE_GAPS * longest), 1)
    bounds = np.linspace(0, n_frames, n + 1).astype(int).tolist()
    return [*pairwise(bounds)]


def _find_gaps_at_the_ends(problem: GapProblem) -> tuple[list[Gap], list[Gap]]:
    """Return the gaps at the beginning and those at the end of the recording.

    Channels that are hidden throughout are left out: there is no place for a copy in them, nor for
    gaps that were copied together with theirs.
    """
    n_frames, gaps = len(problem.given.times), find_gaps(problem.target)
    first = [gap for gap in gaps if gap.start == 0 and gap.stop < n_frames]
    return first, [gap for gap in gaps if gap.stop == n_frames and gap.start > 0]
