"""A round of the race, in which no attempt takes longer than a limit."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from pathlib import Path

from mocapbench.benchmark.filling.attempt import Attempt
from mocapbench.benchmark.filling.trials.runner import Runner
from mocapbench.benchmark.filling.workers import Workers

__all__ = ["InTurn", "Lap"]


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
        self._runners, self._ready = runners, deque(runners)
        self._left = {
            runner: deque(n for n in range(len(questions)) if n not in runner.found)
            for runner in runners
        }
        self._running: dict[Future[Attempt], tuple[Runner, int]] = {}
        self._stopped: set[Runner] = set()

    @property
    def slow(self) -> list[Runner]:
        """Those that took longer than the limit, in the order in which they started."""
        return [runner for runner in self._runners if runner in self._stopped and runner.late]

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
            number, seconds = self._left[runner].popleft(), min(self._limit, left)
            question = self._questions[number]
            future = self._workers.submit(runner.model, question, seconds, "as_claimed")
            self._running[future] = runner, number
            self._started(runner)

    def _end(self, runner: Runner, number: int, attempt: Attempt) -> None:
        runner.take(number, attempt)
        if runner in self._stopped:
            return
        runner.note(attempt)
        if attempt.answer is None:
            self._stopped.add(runner)
            self._ready = deque(other for other in self._ready if other is not runner)
        else:
            self._rejoin(runner)

    def _started(self, runner: Runner) -> None:
        """Note that a runner tries a trial."""

    def _rejoin(self, runner: Runner) -> None:
        """Have a runner wait for its next turn, if it has another trial to do."""
        if self._left[runner] and runner not in self._ready:
            self._ready.append(runner)


class InTurn(Lap):
    """A round in which a model that keeps to the limit has all its trials before the next one.

    All workers try a model once it has answered a trial; before that, one alone.
    """

    def _started(self, runner: Runner) -> None:
        if runner.answers:
            self._rejoin(runner)

    def _rejoin(self, runner: Runner) -> None:
        super()._rejoin(runner)
        self._ready = deque(sorted(self._ready, key=self._runners.index))
