"""The race: which models answer which trials before the time is up.

How long a model takes is not known beforehand. All models are therefore tried with a short limit
first; those that keep to it have all their trials done before the others are tried again, with a
limit that is four times as long. Those go on until they have all their trials, one after another:
of several that had some of them each, none could be compared.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from mocapbench.benchmark.filling.trials.laps import InTurn, Lap
from mocapbench.benchmark.filling.trials.runner import Runner
from mocapbench.benchmark.filling.trials.trial import Trial
from mocapbench.benchmark.filling.workers import Workers

__all__ = ["race"]

_ROUNDS = ((1 / 32, Lap), (1 / 8, InTurn), (1 / 2, InTurn))
"""Of the budget, what one attempt may take; and how models take turns."""


def race(
    models: Sequence[str],
    trials: Sequence[Trial],
    workers: Workers,
    budget: float,
    watch: Callable[[int, int], object],
) -> list[Runner]:
    """Return what each model answered within the budget.

    Parameters
    ----------
    models : sequence of str
        Those that should have an answer if any have come first.
    trials : sequence of Trial
    workers : Workers
    budget : float
        Seconds.
    watch : callable
        Called with the number of answers done and the total.
    """
    questions = [workers.keep(trial.question) for trial in trials]
    deadline = time.monotonic() + budget
    runners = [Runner(model) for model in models]
    waiting = list(runners)
    for share, kind in _ROUNDS:
        lap = kind(waiting, questions, workers, deadline, share * budget)
        lap.run(lambda: watch(sum(len(r.answers) for r in runners), len(models) * len(trials)))
        waiting = lap.slow
    return runners
