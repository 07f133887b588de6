"""Workers: each attempt runs in a killable process, with limits of time and memory."""

from __future__ import annotations

import itertools
import pickle
import time
from collections.abc import Collection
from concurrent.futures import Future
from contextlib import ExitStack
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from types import TracebackType
from typing import Self

from pebble import ProcessExpired

from mocapbench.benchmark.filling.fill_attempt import FillAttempt, attempt_fill
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.registry import MODELS, find_calibration
from mocapbench.benchmark.runs.execution.child import (
    ProcessDiedError,
    call_in_child,
    kill_children,
)
from mocapbench.benchmark.runs.execution.scratch import scratch_folder
from mocapbench.benchmark.runs.execution.worker import load_plugins_once
from mocapbench.benchmark.runs.execution.worker_pool import WorkerPool
from mocapbench.benchmark.runs.machine import memory_share

__all__ = ["Workers"]


class Workers:
    """Processes on this machine that fill gaps; they end with the context.

    Parameters
    ----------
    count : int
        How many attempts run at once.
    plugins : tuple of Path
        The user's own files of models.
    """

    def __init__(self, count: int, plugins: tuple[Path, ...] = ()) -> None:
        self.count = count
        self._plugins = plugins
        self._numbers = itertools.count()
        self._memory = int(memory_share(count) * 2**30)

    def __enter__(self) -> Self:
        with ExitStack() as resources:
            self._folder = resources.enter_context(scratch_folder())
            self._pool = WorkerPool(self.count)
            self._resources = resources.pop_all()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._pool.stop()
        self._resources.close()

    def keep(self, problem: GapProblem) -> Path:
        """Write a problem where the workers read it, and return the file."""
        path = self._folder / f"problem-{next(self._numbers)}"
        path.write_bytes(pickle.dumps(problem, protocol=pickle.HIGHEST_PROTOCOL))
        return path

    def submit(
        self, model: str, problem: Path, seconds: float, method: str = "impute"
    ) -> Future[FillAttempt]:
        """Have a model solve a problem as soon as a worker is free, within so many seconds.

        See `attempt_fill` for the method.
        """
        limits = seconds, self._memory
        return self._pool.submit(_attempt_in_child, model, problem, method, limits, self._plugins)

    def wait_for_any(
        self, futures: Collection[Future[FillAttempt]]
    ) -> Collection[Future[FillAttempt]]:
        """Wait until one or more of ``futures`` have ended, and return them."""
        return self._pool.wait_for_any(futures)

    def collect(self, future: Future[FillAttempt]) -> FillAttempt:
        """Return how an attempt ended, whose worker may have died."""
        try:
            return future.result()
        except ProcessExpired as error:
            return FillAttempt(None, f"its worker died with exit code {error.exitcode}")


def _attempt_in_child(
    name: str, problem: Path, method: str, limits: tuple[float, int], plugins: tuple[Path, ...]
) -> FillAttempt:
    """Return one attempt, made in a child of this process."""
    started, (seconds, memory) = time.perf_counter(), limits
    load_plugins_once(plugins)
    model, calibration, given = MODELS.get(name), find_calibration(name), _read_problem(problem)
    try:
        made: FillAttempt = call_in_child(
            attempt_fill, model, given, memory, method, calibration, timeout=seconds
        )
    except TimeoutError:
        made = FillAttempt(
            None, f"was stopped after {round(seconds, 2):g} s, when its time was up", timed_out=True
        )
    except ProcessDiedError as error:
        made = FillAttempt(None, f"its process died with exit code {error.exit_code}")
    finally:
        kill_children()  # what the model started and left running
    return replace(made, seconds=time.perf_counter() - started)


@lru_cache(maxsize=2)
def _read_problem(path: Path) -> GapProblem:
    problem: GapProblem = pickle.loads(path.read_bytes())
    return problem
