"""The layout of a hold-out: which gaps it copies, and to where.

Copies lie where everything is visible, clear of the real gaps and of each other.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

import numpy as np

from mocapbench.basics.arrays import Index
from mocapbench.basics.mask_runs import MOST_HIDDEN, free_starts
from mocapbench.benchmark.filling.gaps import Episode, Gap
from mocapbench.datasets import Mask

__all__ = ["EpisodeLayout", "EpisodeQueue"]

_SHARES = (1.0, 0.5, 0.25, 0.125)
"""By which gaps are shortened that fit nowhere."""
COPIES = 10
"""Episodes in a hold-out, where there is room for so many."""


class EpisodeQueue:
    """Which of the real gaps is copied next: each group gets equally many copies.

    Within a group, each episode gets equally many.

    Parameters
    ----------
    groups : sequence of sequence of Episode
        None of them is empty.
    rng : numpy.random.Generator
        Of the order in which they are copied.
    """

    def __init__(self, groups: Sequence[Sequence[Episode]], rng: np.random.Generator) -> None:
        self._groups = [*groups]
        self._waiting: list[deque[int]] = [deque() for _ in groups]
        self._turn, self._rng = 0, rng

    def __bool__(self) -> bool:
        return bool(self._groups)

    def peek(self) -> Episode:
        """Return the first episode of the queue, which stays the first until it is popped."""
        group, waiting = self._groups[self._turn], self._waiting[self._turn]
        if not waiting:
            waiting.extend(self._rng.permutation(len(group)).tolist())
        return group[waiting[0]]

    def pop(self) -> None:
        """Remove the first episode from the queue."""
        self._waiting[self._turn].popleft()
        self._turn = (self._turn + 1) % len(self._groups)


class EpisodeLayout:
    """The episodes of one hold-out, as they are placed one by one.

    Parameters
    ----------
    hidden : ndarray of bool of shape (N, D)
        What is hidden already.
    used : ndarray of bool of shape (N,)
        Frames that earlier hold-outs hid; they are avoided, and added to.
    rng : numpy.random.Generator
    """

    def __init__(self, hidden: Mask, used: Mask, rng: np.random.Generator) -> None:
        self.blocked: Mask = hidden.copy()
        self.used: Mask = used
        self.rng = rng
        self.start: int = 0
        self.stop: int = len(hidden)
        self.copies: list[tuple[Gap, Gap]] = []

    def confine(self, start: int, stop: int) -> None:
        """Have the hold-out begin and end at frames, between which all further copies lie."""
        self.start, self.stop = start, stop
        self.blocked[:start] = True
        self.blocked[stop:] = True

    def begin(self, gaps: Sequence[Gap]) -> None:
        """Have the hold-out begin with copies of ``gaps``, within the first third."""
        third = (self.stop - self.start) // 3
        copy = self._place(Episode(tuple(gaps)), self.start, self.start + third) if gaps else None
        if copy:
            self.confine(copy.start, self.stop)

    def end(self, gaps: Sequence[Gap]) -> None:
        """Have the hold-out end with copies of ``gaps``, within the last third."""
        length = max((len(gap) for gap in gaps), default=0)
        first = self.start + 2 * (self.stop - self.start) // 3 - length
        copy = self._place(Episode(tuple(gaps)), first, self.stop) if gaps else None
        if copy:
            self.confine(self.start, copy.stop)

    def place_between(self, queue: EpisodeQueue) -> None:
        """Place copies of the episodes of a queue, as many entries as a hold-out may hide, or one.

        One that does not fit beside those as it is waits for the next hold-out, where it is the
        first. If it does not fit there either, its gaps are placed one by one, and shortened if
        need be: so a long gap does not shorten those that overlap with it.
        """
        room, hidden = MOST_HIDDEN * (self.stop - self.start) * self.blocked.shape[1], 0
        for _ in range(COPIES):
            episode = queue.peek()
            if hidden and hidden + episode.n_entries > room:
                return
            if self._place(episode, self.start, self.stop, _SHARES[:1]) is None:
                if self.copies:
                    return
                for gap in episode.gaps:
                    self._place(Episode((gap,)), self.start, self.stop)
            hidden += episode.n_entries
            queue.pop()

    def _place(
        self, episode: Episode, first: int, stop: int, shares: Sequence[float] = _SHARES
    ) -> Episode | None:
        """Place an episode within [first, stop), with one of the shares; None if it fits not."""
        for share in shares:
            shorter = episode.shorten(share)
            starts = _find_starts(shorter, self.blocked)
            starts = starts[(starts >= first) & (starts + len(shorter) <= stop)]
            if len(starts):
                copy = shorter.move(self._draw_start(starts, len(shorter)) - shorter.start)
                self._add(copy, episode)
                return copy
        return None

    def _add(self, copy: Episode, original: Episode) -> None:
        """Note the copy of each gap with the gap, and block as many frames on both sides.

        They are blocked in all channels, so that held-out gaps do not make each other harder.
        """
        margin = len(copy)
        self.blocked[max(copy.start - margin, 0) : copy.stop + margin] = True
        self.used[copy.start : copy.stop] = True
        self.copies += zip(copy.gaps, original.gaps, strict=True)

    def _draw_start(self, starts: Index, length: int) -> int:
        """Return a random start, where earlier hold-outs hid nothing if there is one."""
        counts = np.concatenate([[0], np.cumsum(self.used)])
        fresh = starts[counts[starts + length] == counts[starts]]
        return int(self.rng.choice(fresh if len(fresh) else starts))


def _find_starts(episode: Episode, blocked: Mask) -> Index:
    """Return the frames, ascending, at which a copy of the episode may start.

    Each of its gaps must lie, with a frame on both sides, where its channels are not blocked.
    """
    starts = np.arange(1, len(blocked) - len(episode))
    for gap in episode.gaps:
        of_gap = free_starts(np.asarray(blocked[:, list(gap.channels)].any(axis=1)), len(gap))
        starts = np.intersect1d(starts, of_gap - (gap.start - episode.start), assume_unique=True)
    return starts
