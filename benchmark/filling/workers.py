"""Workers: each attempt runs in a killable process, with limits of time and memory."""

from __future__ import annotations

import itertools
import pickle
import time
from collections.abc import Collection
from concurrent.futures import Future
from contextlib import ExitStack
from functools import lru_cache
from pathlib import Path
from types import TracebackType
from typing import Self

from pebble import ProcessExpired

from mocapbench.benchmark.filling.attempt import Attempt, attempt
from mocapbench.benchmark.filling.question import GapQuestion
from mocapbench.benchmark.registry import MODELS
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
    """Processes on this machine that answer questions; they end with the context.

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

    def keep(self, question: GapQuestion) -> Path:
        """Write a question where the workers read it, and return the file."""
        path = self._folder / f"question-{next(self._numbers)}"
        path.write_bytes(pickle.dumps(question, protocol=pickle.HIGHEST_PROTOCOL))
        return path

    def submit(
        self, model: str, question: Path, seconds: float, method: str = "impute"
    ) -> Future[Attempt]:
        """Have a model answer a question as soon as a worker is free, within so many seconds.

        See `attempt` for the method.
        """
        limits = seconds, self._memory
        return self._pool.submit(_attempt_fill, model, question, method, limits, self._plugins)

    def ended(self, futures: Collection[Future[Attempt]]) -> Collection[Future[Attempt]]:
        """Wait until one or more of ``futures`` have ended, and return them."""
        return self._pool.wait_for_any(futures)

    def result(self, future: Future[Attempt]) -> Attempt:
        """Return how an attempt ended, whose worker may have died."""
        try:
            return future.result()
        except ProcessExpired as error:
            return Attempt(None, f"its worker died with exit code {error.exitcode}")


def _attempt_fill(
    name: str, question: Path, method: str, limits: tuple[float, int], plugins: tuple[Path, ...]
) -> Attempt:
    """Return one attempt, made in a child of this process."""
    started, (seconds, memory) = time.perf_counter(), limits
    load_plugins_once(plugins)
    model, asked = MODELS.get(name), _question(question)
    try:
        made: Attempt = call_in_child(attempt, model, asked, memory, method, timeout=seconds)
    except TimeoutError:
        made = Attempt(
            None, f"was stopped after {round(seconds, 2):g} s, when its time was up", slow=True
        )
    except ProcessDiedError as error:
        made = Attempt(None, f"its process died with exit code {error.exit_code}")
    finally:
        kill_children()  # what the model started and left running
    return made.taking(time.perf_counter() - started)


@lru_cache(maxsize=2)
def _question(path: Path) -> GapQuestion:
    question: GapQuestion = pickle.loads(path.read_bytes())
    return question
