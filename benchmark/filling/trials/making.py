"""Trials: gaps like the real ones, hidden where the truth is visible.

A trial takes the recording with its real gaps, and hides copies of them elsewhere: of the same
lengths, in the same channels, those together that occur together. At the recording's ends, where a
gap has frames on one side only, the trial begins or ends with the copy.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.filling.gaps import Episode, Gap, episodes_of, gaps_of
from mocapbench.benchmark.filling.question import Question
from mocapbench.benchmark.filling.trials.placement import free_places, occupy
from mocapbench.datasets import Mask

__all__ = ["Trial", "make_trials"]

MOST_TRIALS, ENOUGH_GAPS = 24, 48
"""Trials are made until there are so many of them, or so many trial gaps."""
FEWEST_TRIALS, MOST_ENTRIES = 3, 40_000_000
"""Of long recordings there are fewer: no more than have so many entries (320 MB) in all."""
_HIDDEN_SHARE = 0.15
"""Of the frames, that a trial may hide besides the real gaps, unless one gap alone is longer."""
_COPIES = 10
"""Episodes in a trial, where the recording has fewer and room for more."""
_REPEATS = 10
"""Trials that may repeat others before no more are made."""
_SHARES = (1.0, 0.5, 0.25, 0.125)
"""By which episodes are shortened that fit nowhere."""


@dataclass(frozen=True, eq=False)
class Trial:
    """A question whose answer is known.

    Parameters
    ----------
    question : Question
        The recording, or a part of it that begins or ends with a gap, with more hidden.
    truth : ndarray of shape (M,)
        The values of the wanted entries, in the order of ``np.nonzero(question.target)``.
    units : tuple of ndarray of int
        The places among them (M,) of the entries of each trial gap, which are scored together.
    copies : tuple of Episode
        The trial gaps, at their frames in the whole recording.
    originals : tuple of Episode
        The real gaps of which these are copies.
    share : float
        The length of the shortest trial gap relative to the real one; 1 if none was shortened.
    """

    question: Question
    truth: NDArray[np.float64]
    units: tuple[NDArray[np.intp], ...]
    copies: tuple[Episode, ...]
    originals: tuple[Episode, ...]
    share: float


def make_trials(question: Question, rng: np.random.Generator) -> list[Trial]:
    """Return trials of the gaps that a question asks for; none if there is no room for any.

    No two are alike: some that repeat others are made again, and then no more.
    """
    trials: list[Trial] = []
    made: set[tuple[float, bytes]] = set()
    repeats = 0
    used = np.zeros(len(question.given.times), dtype=bool)
    turns = _Turns(_interior(question), rng)
    most = min(MOST_TRIALS, max(FEWEST_TRIALS, MOST_ENTRIES // question.target.size))
    while len(trials) < most and sum(len(trial.units) for trial in trials) < ENOUGH_GAPS:
        trial = _trial(question, used, turns, rng)
        if trial is None or repeats > _REPEATS:
            break
        if (like := _hidden_where(trial)) in made:
            repeats += 1
            continue
        made.add(like)
        trials.append(trial)
    return trials


def _trial(question: Question, used: Mask, turns: _Turns, rng: np.random.Generator) -> Trial | None:
    """Return one trial, and mark the frames that it hides as used."""
    recording = question.given
    placed = _Placement(~recording.visible, used, rng)
    first, last = _ends(question)
    placed.begin(first)
    placed.end(last)
    placed.within(turns)
    if not placed.episodes:
        return None
    return _made(question, placed)


def _hidden_where(trial: Trial) -> tuple[float, bytes]:
    """Return what tells trials apart: where one begins, and what it hides."""
    return float(trial.question.given.times[0]), trial.question.target.tobytes()


def _ends(question: Question) -> tuple[list[Gap], list[Gap]]:
    """Return the gaps at the beginning and those at the end of the recording."""
    n_frames, gaps = len(question.given.times), gaps_of(question.target)
    first = [gap for gap in gaps if gap.start == 0]
    return first, [gap for gap in gaps if gap.stop == n_frames and gap.start > 0]


def _interior(question: Question) -> tuple[Episode, ...]:
    """Return the episodes of the other gaps."""
    ends = {gap for gaps in _ends(question) for gap in gaps}
    return episodes_of([gap for gap in gaps_of(question.target) if gap not in ends])


class _Turns:
    """Whose turn it is: every episode gets as many copies, over all trials, as every other.

    Parameters
    ----------
    episodes : sequence of Episode
    rng : numpy.random.Generator
        Of the order in which they take turns.
    """

    def __init__(self, episodes: Sequence[Episode], rng: np.random.Generator) -> None:
        self.per_trial = max(_COPIES, len(episodes)) if episodes else 0
        self._episodes, self._rng = episodes, rng
        self._waiting: deque[int] = deque()

    def next(self) -> Episode:
        """Return the episode whose turn it is; the turn stays its own until it is `done`."""
        if not self._waiting:
            self._waiting.extend(self._rng.permutation(len(self._episodes)).tolist())
        return self._episodes[self._waiting[0]]

    def done(self) -> None:
        """Pass the turn on."""
        self._waiting.popleft()


class _Placement:
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

    def within(self, turns: _Turns) -> None:
        """Place copies of the episodes whose turn it is, as many as a trial may hide, or one.

        One that does not fit beside those as it is waits for the next trial, where it is the first;
        there it is shortened if need be.
        """
        room = _HIDDEN_SHARE * (self.stop - self.start)
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
            if placed is None:
                for gap in episode.gaps if len(episode.gaps) > 1 else ():
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
                occupy(self.blocked, placed)
                self.used[placed.start : placed.stop] = True
                self.episodes.append(placed)
                self.originals.append(episode)
                self.share = min(self.share, share)
                return placed
        return None

    def _chosen(self, places: np.ndarray, length: int) -> int:
        """Return a random one of the places, where earlier trials hid nothing if there is one."""
        counts = np.concatenate([[0], np.cumsum(self.used)])
        fresh = places[counts[places + length] == counts[places]]
        return int(self.rng.choice(fresh if len(fresh) else places))


def _made(question: Question, placed: _Placement) -> Trial:
    frames = np.arange(placed.start, placed.stop)
    recording = question.given.frames(frames)
    owners = np.full(question.target.shape, -1, dtype=np.int32)
    for number, episode in enumerate(placed.episodes):
        for gap in episode.gaps:
            owners[gap.start : gap.stop, list(gap.channels)] = number
    owners = owners[frames]
    target = owners >= 0
    units = (np.flatnonzero(owners[target] == number) for number in range(len(placed.episodes)))
    return Trial(
        question=Question(recording.hide(target), target, question.train),
        truth=recording.values[target],
        units=tuple(units),
        copies=tuple(placed.episodes),
        originals=tuple(placed.originals),
        share=placed.share,
    )
