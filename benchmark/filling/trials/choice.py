"""The choice of a model by trials."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.able import able_models
from mocapbench.benchmark.filling.question import GapQuestion
from mocapbench.benchmark.filling.trials.bands import coverage
from mocapbench.benchmark.filling.trials.comparison import Choice, compared
from mocapbench.benchmark.filling.trials.making import has_room, make_trials
from mocapbench.benchmark.filling.trials.race import race
from mocapbench.benchmark.filling.workers import Workers

__all__ = ["NoneInTimeError", "choose", "require_room"]

_SEED = 0
_FOR_BANDS = 0.5
"""Of the budget, what bands may take besides."""


class NoneInTimeError(UsageError):
    """No model answered a trial within its part of the budget."""


def choose(
    question: GapQuestion, workers: Workers, budget: float, watch: Callable[[int, int], object]
) -> Choice:
    """Return which model fills gaps like those of a question best.

    Parameters
    ----------
    question : GapQuestion
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
        raise _no_room(question)
    runners = race(models, trials, workers, budget, watch)
    if not any(runner.answers for runner in runners):
        raise NoneInTimeError(
            f"{question.given.name}: expected a model that fills a trial gap in its part of the "
            f"budget of {budget:g} s, got none ({runners[0].model}: {runners[0].trouble}); raise "
            "--budget"
        )
    choice = compared(trials, runners)
    best = choice.ranking.order[0]
    if not choice.ranking.scores[best].has_bands:
        return choice
    return replace(choice, coverage=coverage(best, trials, workers, _FOR_BANDS * budget))


def require_room(question: GapQuestion) -> None:
    """Refuse a recording on which no model can be tried.

    Raises
    ------
    UsageError
        The message says what to do.
    """
    if not has_room(question, np.random.default_rng(_SEED)):
        raise _no_room(question)


def _no_room(question: GapQuestion) -> UsageError:
    return UsageError(
        f"{question.given.name}: expected a visible stretch to try models on, got none that is "
        f"free of gaps; {_advice(question, able_models(question))}"
    )


def _advice(question: GapQuestion, models: Sequence[str]) -> str:
    """Return how to go on where the recording itself cannot tell which model to take."""
    advice = f"name a model with --model: {', '.join(models)}"
    if len(question.train) > 1 and "best-of" in models:
        advice += "; best-of tries others on the files of --train"
    return advice
