"""The race: which models answer which trials before the time is up.

How long a model takes is not known beforehand. All models are therefore tried with a short limit
first; those that keep to it have all their trials done before the others are tried again, with a
limit that is four times as long. Those go on until they have all their trials, one after another:
of several that had some of them each, none could be compared.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from pathlib import Path

from mocapbench.benchmark.filling.attempt import Attempt, as_claimed
from mocapbench.benchmark.filling.question import Answer
from mocapbench.benchmark.filling.trials.trial import Trial
from mocapbench.benchmark.filling.workers import Workers

__all__ = ["Runner", "race"]

_ROUNDS = ((1 / 32, deque.append), (1 / 8, deque.appendleft), (1 / 2, deque.appendleft))
"""Of the budget, what one attempt may take; and where a model goes that has more trials to do."""


@dataclass(eq=False)
class Runner:
    """A model in the race.

    Parameters
    ----------
    model : str
    answers : list of Answer
        To the first trials, in order.
    trouble : str
        Why it has no more of them.
    late : bool
        Whether that is because its time, or the budget, was used up.
    windows : int
        Into how many windows it had the longest trial cut; 0 if into none.
    seconds : float
        What its attempts took, those that were stopped too.
    """

    model: str
    answers: list[Answer] = field(default_factory=list)
    trouble: str = ""
    late: bool = False
    windows: int = 0
    seconds: float = 0.0

    def take(self, attempt: Attempt) -> None:
        """Take note of how an attempt ended."""
        self.seconds += attempt.seconds
        self.trouble, self.late = attempt.trouble, attempt.slow
        self.windows = max(self.windows, attempt.windows)
        if attempt.answer is not None:
            self.answers.append(attempt.answer)


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
    for limit, rejoin in _ROUNDS:
        lap = _Lap(waiting, questions, workers, deadline, limit=limit * budget, rejoin=rejoin)
        lap.run(lambda: watch(sum(len(r.answers) for r in runners), len(models) * len(trials)))
        waiting = lap.slow
    return runners


class _Lap:
    """A round of the race, in which no attempt takes longer than a limit."""

    def __init__(
        self,
        runners: Sequence[Runner],
        questions: Sequence[Path],
        workers: Workers,
        deadline: float,
        *,
        limit: float,
        rejoin: Callable[[deque[Runner], Runner], None],
    ) -> None:
        self._ready = deque(runners)
        self._questions, self._workers = questions, workers
        self._deadline, self._limit, self._rejoin = deadline, limit, rejoin
        self._running: dict[Future[Attempt], Runner] = {}
        self.slow: list[Runner] = []
        """Those that took longer than the limit."""

    def run(self, watch: Callable[[], object]) -> None:
        """Have the runners answer one question after another, until none can go on."""
        while True:
            self._start()
            if not self._running:
                return
            for future in self._workers.ended(self._running.keys()):
                self._end(self._running.pop(future), self._workers.result(future))
            watch()

    def _start(self) -> None:
        while self._ready and len(self._running) < self._workers.count:
            runner, left = self._ready.popleft(), self._deadline - time.monotonic()
            if left <= 0:
                runner.trouble = runner.trouble or "the budget was used up before its turn"
                runner.late = True
                continue
            question = self._questions[len(runner.answers)]
            seconds = min(self._limit, left)
            future = self._workers.submit(runner.model, question, seconds, as_claimed)
            self._running[future] = runner

    def _end(self, runner: Runner, attempt: Attempt) -> None:
        runner.take(attempt)
        if attempt.slow:
            self.slow.append(runner)
        elif attempt.answer is not None and len(runner.answers) < len(self._questions):
            self._rejoin(self._ready, runner)
