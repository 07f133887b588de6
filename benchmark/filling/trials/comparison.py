"""Models compared over the same trials, and which trials these are."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.filling.trials.bands import Coverage
from mocapbench.benchmark.filling.trials.places import places_of
from mocapbench.benchmark.filling.trials.ranking import Ranking, rank
from mocapbench.benchmark.filling.trials.runner import Runner
from mocapbench.benchmark.filling.trials.scores import held_errors, scores_of, weights_of
from mocapbench.benchmark.filling.trials.trial import Trial

__all__ = ["Choice", "compared"]


@dataclass(frozen=True, eq=False)
class Choice:
    """How models did in trials.

    Parameters
    ----------
    ranking : Ranking
        Of the models that answered the same trials.
    left_out : tuple of Runner
        The others.
    share : float
        The length of the shortest trial gap relative to the real one.
    seconds : mapping of str to float
        What a trial took each ranked model on average.
    windows : mapping of str to int
        Into how many windows each ranked model had a trial cut; 0 if into none.
    unused : int
        How many more trials others had than the first model had time for.
    coverage : Coverage or None
        What the bands of the first model hold in trials; None if it has none, or no time was left.
    """

    ranking: Ranking
    left_out: tuple[Runner, ...]
    share: float
    seconds: Mapping[str, float]
    windows: Mapping[str, int]
    unused: int = 0
    coverage: Coverage | None = None


def compared(trials: Sequence[Trial], runners: Sequence[Runner]) -> Choice:
    """Return the ranking by as many trials as most of the answers allow.

    A model that had no more than fewer of them is chosen by these, if it leads there by more than
    chance.

    Parameters
    ----------
    trials : sequence of Trial
    runners : sequence of Runner
        At least one has an answer.
    """
    return _led_by_more_than_chance(trials, runners, _ranked(trials[: _common(runners)], runners))


def _common(runners: Sequence[Runner]) -> int:
    """Return by how many of the first trials to compare: those with most answers in all."""
    counts = sorted((len(runner.answers) for runner in runners), reverse=True)
    totals = [count * place for place, count in enumerate(counts, start=1)]
    return counts[int(np.argmax(totals))]


def _led_by_more_than_chance(
    trials: Sequence[Trial], runners: Sequence[Runner], most: Choice
) -> Choice:
    """Return the choice by fewer trials, if a model that had no more leads by more than chance."""
    n_most = max(len(runner.answers) for runner in runners if runner.model in most.seconds)
    for count in sorted({len(runner.answers) for runner in runners} - {0}, reverse=True):
        fewer = _ranked(trials[:count], runners)
        if _of_all_gaps(trials[:count], trials[:n_most]) and _leads(fewer, most):
            by_trial = _ranked(trials[:count], runners, _trial_of)
            if _leads(by_trial, most):
                return replace(fewer, unused=n_most - count)
    return most


def _of_all_gaps(fewer: Sequence[Trial], more: Sequence[Trial]) -> bool:
    """Return whether fewer trials have copies of all gaps of which more trials have some."""
    of_fewer, of_more = ({gap for t in trials for gap in t.originals} for trials in (fewer, more))
    return of_fewer == of_more


def _leads(fewer: Choice, most: Choice) -> bool:
    """Return whether a model that most leaves out is better than all others by more than chance."""
    ranking, others = fewer.ranking, most.ranking.scores.keys()
    return ranking.tested and not others & set(ranking.sharing)


def _trial_of(trials: Sequence[Trial]) -> NDArray[np.intp]:
    """Return the number of each trial gap's trial (n,): a fit makes its errors large or small."""
    return np.repeat(np.arange(len(trials)), [len(trial.units) for trial in trials])


def _ranked(
    trials: Sequence[Trial],
    runners: Sequence[Runner],
    units_of: Callable[[Sequence[Trial]], NDArray[np.intp]] = places_of,
) -> Choice:
    scales = held_errors(trials)
    scores = {
        runner.model: scores_of(trials, runner.answers[: len(trials)], scales)
        for runner in runners
        if len(runner.answers) >= len(trials)
    }
    return Choice(
        ranking=rank(scores, weights_of(trials), units_of(trials)),
        left_out=tuple(runner for runner in runners if runner.model not in scores),
        share=min(trial.share for trial in trials),
        seconds={r.model: r.seconds / len(r.answers) for r in runners if r.model in scores},
        windows={r.model: r.windows for r in runners if r.model in scores},
    )
