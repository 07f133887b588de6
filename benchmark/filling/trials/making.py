"""Trials: gaps like the real ones, hidden where the truth is visible.

A trial takes the recording with its real gaps, and hides copies of them elsewhere: of the same
lengths, in the same channels, those together that occur together. At the recording's ends, where a
gap has frames on one side only, the trial begins or ends with the copy.
"""

from __future__ import annotations

import numpy as np

from mocapbench.benchmark.filling.gaps import Episode, Gap, episodes_of, gaps_of
from mocapbench.benchmark.filling.question import GapQuestion
from mocapbench.benchmark.filling.trials.layout import EpisodeLayout
from mocapbench.benchmark.filling.trials.trial import Trial
from mocapbench.benchmark.filling.trials.turns import Turns
from mocapbench.datasets import Mask

__all__ = ["has_room", "make_trials"]

MOST_TRIALS, ENOUGH_GAPS = 24, 48
"""Trials are made until there are so many of them, or so many trial gaps."""
FEWEST_TRIALS, MOST_ENTRIES = 3, 40_000_000
"""Of long recordings there are fewer: no more than have so many entries (320 MB) in all."""
_REPEATS = 10
"""Trials that may repeat others before no more are made."""


def make_trials(question: GapQuestion, rng: np.random.Generator) -> list[Trial]:
    """Return trials of the gaps that a question asks for; none if there is no room for any.

    No two are alike: some that repeat others are made again, and then no more.
    """
    trials: list[Trial] = []
    made: set[tuple[float, bytes]] = set()
    repeats = 0
    used = np.zeros(len(question.given.times), dtype=bool)
    turns = Turns(_interior(question), rng)
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


def has_room(question: GapQuestion, rng: np.random.Generator) -> bool:
    """Return whether there is room for a trial of the gaps that a question asks for."""
    used = np.zeros(len(question.given.times), dtype=bool)
    return _trial(question, used, Turns(_interior(question), rng), rng) is not None


def _trial(
    question: GapQuestion, used: Mask, turns: Turns, rng: np.random.Generator
) -> Trial | None:
    """Return one trial, and mark the frames that it hides as used."""
    recording = question.given
    layout = EpisodeLayout(~recording.visible, used, rng)
    first, last = _ends(question)
    layout.begin(first)
    layout.end(last)
    layout.within(turns)
    if not layout.episodes:
        return None
    return _made(question, layout)


def _hidden_where(trial: Trial) -> tuple[float, bytes]:
    """Return what tells trials apart: where one begins, and what it hides."""
    return float(trial.question.given.times[0]), trial.question.target.tobytes()


def _ends(question: GapQuestion) -> tuple[list[Gap], list[Gap]]:
    """Return the gaps at the beginning and those at the end of the recording."""
    n_frames, gaps = len(question.given.times), gaps_of(question.target)
    first = [gap for gap in gaps if gap.start == 0]
    return first, [gap for gap in gaps if gap.stop == n_frames and gap.start > 0]


def _interior(question: GapQuestion) -> tuple[Episode, ...]:
    """Return the episodes of the other gaps."""
    ends = {gap for gaps in _ends(question) for gap in gaps}
    return episodes_of([gap for gap in gaps_of(question.target) if gap not in ends])


def _made(question: GapQuestion, layout: EpisodeLayout) -> Trial:
    frames = np.arange(layout.start, layout.stop)
    recording = question.given.frames(frames)
    owners = np.full(question.target.shape, -1, dtype=np.int32)
    for number, episode in enumerate(layout.episodes):
        for gap in episode.gaps:
            owners[gap.start : gap.stop, list(gap.channels)] = number
    owners = owners[frames]
    target = owners >= 0
    units = (np.flatnonzero(owners[target] == number) for number in range(len(layout.episodes)))
    return Trial(
        question=GapQuestion(recording.hide(target), target, question.train),
        truth=recording.values[target],
        units=tuple(units),
        copies=tuple(layout.episodes),
        originals=tuple(layout.originals),
        share=layout.share,
    )
