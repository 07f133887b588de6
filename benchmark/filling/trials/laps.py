"""A round of the race, in which no attempt takes longer than a limit."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from itertools import count, takewhile
from pathlib import Path

from mocapbench.benchmark.filling.attempt import Attempt, as_claimed
from mocapbench.benchmark.filling.question import Answer
from mocapbench.benchmark.filling.workers import Workers

__all__ = ["Lap", "OneByOne", "Runner"]


@dataclass(eq=False)
class Runner:
    """A model in the race.

    Parameters
    ----------
    model : str
    found : dict of int to Answer
        Its answers, by the number of the trial.
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
    found: dict[int, Answer] = field(default_factory=dict)
    trouble: str = ""
    late: bool = False
    windows: int = 0
    seconds: float = 0.0

    @property
    def answers(self) -> list[Answer]:
        """Those to the first trials, in order, up to one that it has not answered."""
        return [self.found[number] for number in takewhile(self.found.__contains__, count())]

    def take(self, number: int, attempt: Attempt) -> None:
        """Take note of how an attempt at a trial ended."""
        self.seconds += attempt.seconds
        self.trouble, self.late = attempt.trouble, attempt.slow
        self.windows = max(self.windows, attempt.windows)
        if attempt.answer is not None:
            self.found[number] = attempt.answer


class Lap:
    """A round in which models take turns, a trial each.

    Parameters
    ----------
    runners : sequence of Runner
        In the order in which they start.
    questions : sequence of Path
        The trials, as workers keep them.
    workers : Workers
    deadline : float
        Of the monotonic clock, after which nothing is started.
    limit : float
        Seconds that an attempt may take.
    """

    def __init__(
        self,
        runners: Sequence[Runner],
        questions: Sequence[Path],
        workers: Workers,
        deadline: float,
        limit: float,
    ) -> None:
        self._questions, self._workers = questions, workers
        self._deadline, self._limit = deadline, limit
        self._ready = deque(runners)
        self._places = {runner: place for place, runner in enumerate(runners)}
        self._next = {runner: len(runner.answers) for runner in runners}
        self._running: dict[Future[Attempt], tuple[Runner, int]] = {}
        self._stopped: list[Runner] = []

    @property
    def slow(self) -> list[Runner]:
        """Those that took longer than the limit."""
        return [runner for runner in self._stopped if runner.late]

    def run(self, watch: Callable[[], object]) -> None:
        """Have the runners answer one question after another, until none can go on."""
        while True:
            self._start()
            if not self._running:
                return
            for future in self._workers.ended(self._running.keys()):
                self._end(*self._running.pop(future), self._workers.result(future))
            watch()

    def _start(self) -> None:
        while self._ready and len(self._running) < self._workers.count:
            runner, left = self._ready.popleft(), self._deadline - time.monotonic()
            if left <= 0:
                runner.trouble = runner.trouble or "the budget was used up before its turn"
                runner.late = True
                continue
            number, seconds = self._next[runner], min(self._limit, left)
            self._next[runner] += 1
            question = self._questions[number]
            future = self._workers.submit(runner.model, question, seconds, as_claimed)
            self._running[future] = runner, number
            self._started(runner)

    def _end(self, runner: Runner, number: int, attempt: Attempt) -> None:
        if runner in self._stopped:
            return
        runner.take(number, attempt)
        if attempt.answer is not None:
            self._answered(runner)
            return
        self._stopped.append(runner)
        if runner in self._ready:
            self._ready.remove(runner)

    def _started(self, runner: Runner) -> None:
        """Note that a runner tries a trial."""

    def _answered(self, runner: Runner) -> None:
        """Note that a runner has answered a trial."""
        self._rejoin(runner)

    def _rejoin(self, runner: Runner) -> None:
        """Have a runner wait for its next turn, if it has another trial to do."""
        if self._next[runner] < len(self._questions) and runner not in self._ready:
            self._ready.append(runner)


class OneByOne(Lap):
    """A round in which a model that keeps to the limit has all its trials before the next one.

    From its first answer on, all workers try it at once.
    """

    def _started(self, runner: Runner) -> None:
        if runner.answers:
            self._rejoin(runner)

    def _rejoin(self, runner: Runner) -> None:
        super()._rejoin(runner)
        self._ready = deque(sorted(self._ready, key=self._places.__getitem__))
