"""The layout of a trial: which gaps it hides, and where."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.basics.gaps import MOST_HIDDEN
from mocapbench.benchmark.filling.gaps import Episode, Gap
from mocapbench.benchmark.filling.trials.placement import free_places, occupy
from mocapbench.benchmark.filling.trials.turns import Turns
from mocapbench.datasets import Mask

__all__ = ["EpisodeLayout"]

_SHARES = (1.0, 0.5, 0.25, 0.125)
"""By which episodes are shortened that fit nowhere."""


class EpisodeLayout:
    """The episodes of one trial, as they are placed one by one.

    Parameters
    ----------
    hidden : ndarray of bool of shape (N, D)
        What is hidden already.
    used : ndarray of bool of shape (N,)
        Frames that earlier trials hid; they are avoided, and added to.
    rng : numpy.random.Generator
    """

    def __init__(self, hidden: Mask, used: Mask, rng: np.random.Generator) -> None:
        self.blocked, self.used, self.rng = hidden.copy(), used, rng
        self.start, self.stop = 0, len(hidden)
        self.episodes: list[Episode] = []
        self.originals: list[Episode] = []
        self.share = 1.0

    def begin(self, gaps: Sequence[Gap]) -> None:
        """Have the trial begin with copies of ``gaps``, within the first third."""
        placed = self._put(Episode(tuple(gaps)), 0, self.stop // 3) if gaps else None
        if placed:
            self.start = placed.start
            self.blocked[: placed.start] = True

    def end(self, gaps: Sequence[Gap]) -> None:
        """Have the trial end with copies of ``gaps``, within the last third."""
        length = max((len(gap) for gap in gaps), default=0)
        first = 2 * self.stop // 3 - length
        placed = self._put(Episode(tuple(gaps)), max(first, 0), self.stop) if gaps else None
        if placed:
            self.stop = placed.stop
            self.blocked[placed.stop :] = True

    def within(self, turns: Turns) -> None:
        """Place copies of the episodes whose turn it is, as many as a trial may hide, or one.

        One that does not fit beside those as it is waits for the next trial, where it is the first;
        there it is shortened if need be.
        """
        room = MOST_HIDDEN * (self.stop - self.start)
        hidden, at_the_ends = 0, len(self.episodes)
        for _ in range(turns.per_trial):
            episode = turns.next()
            if hidden and hidden + len(episode) > room:
                return
            beside = len(self.episodes) > at_the_ends
            shares = _SHARES[:1] if beside else _SHARES
            placed = self._put(episode, self.start, self.stop, shares)
            if placed is None and beside:
                return
            hidden += len(episode)
            turns.done()
            if placed is None and len(episode.gaps) > 1:
                self._put_apart(episode)

    def _put_apart(self, episode: Episode) -> None:
        """Place the gaps of an episode that does not fit as a whole, each by itself."""
        for gap in episode.gaps:
            self._put(Episode((gap,)), self.start, self.stop)

    def _put(
        self, episode: Episode, first: int, stop: int, shares: Sequence[float] = _SHARES
    ) -> Episode | None:
        """Place an episode within [first, stop), with one of the shares; None if it fits not."""
        for share in shares:
            shorter = episode.shortened(share)
            places = free_places(shorter, self.blocked)
            places = places[(places >= first) & (places + len(shorter) <= stop)]
            if len(places):
                placed = shorter.moved(self._chosen(places, len(shorter)) - shorter.start)
                self._add(placed, episode, share)
                return placed
        return None

    def _add(self, placed: Episode, original: Episode, share: float) -> None:
        occupy(self.blocked, placed)
        self.used[placed.start : placed.stop] = True
        self.episodes.append(placed)
        self.originals.append(original)
        self.share = min(self.share, share)

    def _chosen(self, places: np.ndarray, length: int) -> int:
        """Return a random one of the places, where earlier trials hid nothing if there is one."""
        counts = np.concatenate([[0], np.cumsum(self.used)])
        fresh = places[counts[places + length] == counts[places]]
        return int(self.rng.choice(fresh if len(fresh) else places))
