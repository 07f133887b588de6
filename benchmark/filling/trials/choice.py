"""The choice of a model by trials."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.able import able_models
from mocapbench.benchmark.filling.question import Question
from mocapbench.benchmark.filling.trials.bands import Coverage, coverage
from mocapbench.benchmark.filling.trials.making import make_trials
from mocapbench.benchmark.filling.trials.places import places_of
from mocapbench.benchmark.filling.trials.race import race
from mocapbench.benchmark.filling.trials.ranking import Ranking, rank
from mocapbench.benchmark.filling.trials.runner import Runner
from mocapbench.benchmark.filling.trials.scores import held_errors, scores_of, weights_of
from mocapbench.benchmark.filling.trials.trial import Trial
from mocapbench.benchmark.filling.workers import Workers

__all__ = ["Choice", "NoneInTimeError", "choose"]

_SEED = 0
_FOR_BANDS = 0.5
"""Of the budget, what bands may take besides."""


class NoneInTimeError(UsageError):
    """No model answered a trial within its part of the budget."""


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


def choose(
    question: Question, workers: Workers, budget: float, watch: Callable[[int, int], object]
) -> Choice:
    """Return which model fills gaps like those of a question best.

    Parameters
    ----------
    question : Question
    workers : Workers
    budget : float
        Seconds to compare models; half as many more may go to the bands of the best.
    watch : callable
        Called with the number of answers done and the total.

    Raises
    ------
    NoneInTimeError
        If no model answers a trial within the budget.
    UsageError
        If there is no room for a trial.
    """
    models = able_models(question)
    trials = make_trials(question, np.random.default_rng(_SEED))
    if not trials:
        raise UsageError(
            f"{question.given.name}: expected a visible stretch to try models on, got none that is "
            f"free of gaps; {_advice(question, models)}"
        )
    runners = race(models, trials, workers, budget, watch)
    count = _common(runners)
    if count == 0:
        raise NoneInTimeError(
            f"{question.given.name}: expected a model that fills a trial gap in its part of the "
            f"budget of {budget:g} s, got none ({runners[0].model}: {runners[0].trouble}); raise "
            "--budget"
        )
    choice = _led_by_more_than_chance(trials, runners, _ranked(trials[:count], runners))
    best = choice.ranking.order[0]
    if not choice.ranking.scores[best].has_bands:
        return choice
    return replace(choice, coverage=coverage(best, trials, workers, _FOR_BANDS * budget))


def _advice(question: Question, models: Sequence[str]) -> str:
    """Return how to go on where the recording itself cannot tell which model to take."""
    advice = f"name a model with --model: {', '.join(models)}"
    if len(question.train) > 1 and "best-of" in models:
        advice += "; best-of tries others on the files of --train"
    return advice


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
