"""The schedule by which models fill hold-outs before the time is up.

How long a model takes is not known beforehand. As in successive halving (Jamieson and Talwalkar
2016, *AISTATS*, PMLR 51:240–248), all models begin as contenders with little time each, and later
rounds give more time to fewer. Here a contender is not dropped for its errors, but goes on to the
next round if a hold-out took it longer than the limit of the round, which is then four times as
long. In the first round, contenders fill a hold-out each in turn, and those that keep to the limit
fill all. In later rounds they go on until they have filled all, one contender after another: of
several that had filled some each, none could be compared.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from itertools import count, takewhile
from pathlib import Path

from mocapbench.benchmark.filling.choosing.hold_outs import HoldOut
from mocapbench.benchmark.filling.fill_attempt import FillAttempt
from mocapbench.benchmark.filling.gap_problem import PredictedEntries
from mocapbench.benchmark.filling.workers import Workers

__all__ = ["Contender", "run_rounds"]


@dataclass(eq=False)
class Contender:
    """A model, and how it filled hold-outs.

    Parameters
    ----------
    model : str
    predicted : dict of int to PredictedEntries
        What it predicted, by the number of the hold-out.
    failure : str
        Why it has no more predictions.
    timed_out : bool
        Whether that is because its time, or the budget, was used up.
    n_windows : int
        Into how many windows it had the longest hold-out cut; 0 if into none.
    seconds : float
        What its attempts took, those that were stopped too.
    """

    model: str
    predicted: dict[int, PredictedEntries] = field(default_factory=dict)
    failure: str = ""
    timed_out: bool = False
    n_windows: int = 0
    seconds: float = 0.0

    @property
    def predictions(self) -> list[PredictedEntries]:
        """Those of the first hold-outs, in order, up to one that it has not filled."""
        numbers = takewhile(self.predicted.__contains__, count())
        return [self.predicted[number] for number in numbers]

    def record_prediction(self, number: int, attempt: FillAttempt) -> None:
        """Record what an attempt at a hold-out took, and what it predicted, if anything."""
        self.seconds += attempt.seconds
        self.n_windows = max(self.n_windows, attempt.n_windows)
        if attempt.prediction is not None:
            self.predicted[number] = attempt.prediction

    def record_ending(self, attempt: FillAttempt) -> None:
        """Record how the attempt ended that decides whether the contender goes on."""
        self.failure, self.timed_out = attempt.failure, attempt.timed_out


class Round:
    """A round in which contenders fill a hold-out each in turn, none for longer than a limit.

    Parameters
    ----------
    contenders : sequence of Contender
        In the order in which they start.
    problems : sequence of Path
        The hold-outs, as workers keep them.
    workers : Workers
    deadline : float
        Of the monotonic clock, after which nothing is started.
    limit : float
        Seconds that an attempt may take.
    """

    def __init__(
        self,
        contenders: Sequence[Contender],
        problems: Sequence[Path],
        workers: Workers,
        deadline: float,
        limit: float,
    ) -> None:
        self._problems, self._workers = problems, workers
        self._deadline, self._limit = deadline, limit
        self._contenders, self._ready = contenders, deque(contenders)
        self._left = {
            contender: deque(n for n in range(len(problems)) if n not in contender.predicted)
            for contender in contenders
        }
        self._running: dict[Future[FillAttempt], tuple[Contender, int]] = {}
        self._stopped: set[Contender] = set()

    @property
    def timed_out(self) -> list[Contender]:
        """Those that took longer than the limit, in the order in which they started."""
        return [one for one in self._contenders if one in self._stopped and one.timed_out]

    def run(self, watch: Callable[[], object]) -> None:
        """Have the contenders fill one hold-out after another, until none can go on."""
        while True:
            self._start_attempts()
            if not self._running:
                return
            for future in self._workers.wait_for_any(self._running.keys()):
                self._end_attempt(*self._running.pop(future), self._workers.collect(future))
            watch()

    def _start_attempts(self) -> None:
        while self._ready and len(self._running) < self._workers.count:
            contender, left = self._ready.popleft(), self._deadline - time.monotonic()
            if left <= 0:
                contender.failure = contender.failure or "the budget was used up before it started"
                contender.timed_out = True
                continue
            number, seconds = self._left[contender].popleft(), min(self._limit, left)
            problem = self._problems[number]
            future = self._workers.submit(contender.model, problem, seconds, "impute_uncalibrated")
            self._running[future] = contender, number
            self._follow_start(contender)

    def _end_attempt(self, contender: Contender, number: int, attempt: FillAttempt) -> None:
        contender.record_prediction(number, attempt)
        if contender in self._stopped:
            return
        contender.record_ending(attempt)
        if attempt.prediction is None:
            self._stopped.add(contender)
            self._ready = deque(other for other in self._ready if other is not contender)
        else:
            self._rejoin(contender)

    def _follow_start(self, contender: Contender) -> None:
        """Do what is to be done when a contender has started on a hold-out."""

    def _rejoin(self, contender: Contender) -> None:
        """Have a contender wait for its next hold-out, if it has another to fill."""
        if self._left[contender] and contender not in self._ready:
            self._ready.append(contender)


class SequentialRound(Round):
    """A round in which a contender that keeps to the limit fills all before the next one starts.

    All workers serve a contender once it has filled a hold-out; before that, one alone.
    """

    def _follow_start(self, contender: Contender) -> None:
        if contender.predictions:
            self._rejoin(contender)

    def _rejoin(self, contender: Contender) -> None:
        super()._rejoin(contender)
        self._ready = deque(sorted(self._ready, key=self._contenders.index))


_ROUNDS = ((1 / 32, Round), (1 / 8, SequentialRound), (1 / 2, SequentialRound))
"""Of the budget, what one attempt may take; and in which order contenders fill hold-outs."""


def run_rounds(
    models: Sequence[str],
    hold_outs: Sequence[HoldOut],
    workers: Workers,
    budget: float,
    watch: Callable[[int, int], object],
) -> list[Contender]:
    """Return what each model predicted within the budget.

    Parameters
    ----------
    models : sequence of str
        Those that should have a prediction if any have come first.
    hold_outs : sequence of HoldOut
    workers : Workers
    budget : float
        Seconds.
    watch : callable
        Called with the number of hold-outs that models have filled and the total.
    """
    problems = [workers.keep(hold_out.problem) for hold_out in hold_outs]
    deadline, total = time.monotonic() + budget, len(models) * len(hold_outs)
    contenders = [Contender(model) for model in models]
    waiting = list(contenders)
    for share, kind in _ROUNDS:
        current = kind(waiting, problems, workers, deadline, share * budget)
        current.run(lambda: watch(sum(len(one.predictions) for one in contenders), total))
        waiting = current.timed_out
    return contenders
