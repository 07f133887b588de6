"""Workers: each attempt runs in a killable process, with limits of time and memory."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection
from concurrent.futures import Future
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from types import TracebackType
from typing import Any, Protocol, Self

import joblib
from pebble import ProcessExpired

from mocapbench.basics.child import LONGEST, ProcessDiedError, call_in_child
from mocapbench.basics.scratch import scratch_folder
from mocapbench.basics.system.choice import find_system
from mocapbench.benchmark.filling.fill_attempt import FillAttempt, attempt_fill
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.registry import MODELS, find_calibration
from mocapbench.benchmark.runs.execution.worker import load_plugins_once
from mocapbench.benchmark.runs.execution.worker_context import worker_context_without_script
from mocapbench.benchmark.runs.execution.worker_pool import WorkerPool
from mocapbench.benchmark.runs.machine import memory_share

__all__ = ["FillBackend", "Workers"]

_TIMES, _LEAST_LIMIT = 20.0, 120.0
"""How many times the predicted processor time an attempt may take, and how many seconds at least.

So a busy machine takes longer, and computes the same.
"""
_WAITING = 5.0
"""How many times as long as that an attempt may last: a model that only waits takes no such time.
"""


class FillBackend(Protocol):
    """Where models fill problems: in `Workers`, or in the process that asks.

    Attributes
    ----------
    seed : int
        Of what models draw at random.
    """

    seed: int

    def keep(self, problem: GapProblem) -> Any:
        """Return what stands for a problem in `submit`."""

    def submit(
        self, model: str, problem: Any, seconds: float, method: str = "impute"
    ) -> Future[FillAttempt]:
        """Have a model solve a problem; see `Workers.submit`."""

    def collect(
        self,
        futures: Collection[Future[FillAttempt]],
        watch: Callable[[int, int], object] = ...,
    ) -> dict[Future[FillAttempt], FillAttempt]:
        """Return how attempts ended; see `Workers.collect`."""


class Workers:
    """Processes on this machine that fill gaps; they end with the context.

    Parameters
    ----------
    count : int
        How many attempts run at once.
    plugins : tuple of Path
        The user's own files of models.
    seed : int
        Of what models draw at random.
    """

    def __init__(self, count: int, plugins: tuple[Path, ...] = (), seed: int = 0) -> None:
        self._count = count
        self.seed: int = seed
        self._numbers = itertools.count()
        memory = int(memory_share(count) * 2**30)
        self._attempt = partial(_attempt_in_child, memory=memory, seed=seed, plugins=plugins)

    def __enter__(self) -> Self:
        with ExitStack() as resources:
            self._folder = resources.enter_context(scratch_folder())
            self._pool = WorkerPool(self._count, worker_context_without_script)
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
        joblib.dump(problem, path)
        return path

    def submit(
        self, model: str, problem: Path, seconds: float, method: str = "impute"
    ) -> Future[FillAttempt]:
        """Have a model solve a problem as soon as a worker is free.

        It is stopped if it takes many times the predicted seconds of a core. See `attempt_fill`
        for the method.
        """
        limit = max(_TIMES * seconds, _LEAST_LIMIT)
        return self._pool.submit(self._attempt, model, problem, method, limit, _WAITING * limit)

    def collect(
        self,
        futures: Collection[Future[FillAttempt]],
        watch: Callable[[int, int], object] = lambda *_: None,
    ) -> dict[Future[FillAttempt], FillAttempt]:
        """Return how attempts ended, whose workers may have died.

        Parameters
        ----------
        futures : collection of Future
        watch : callable, optional
            Called with the number of attempts that have ended and that of all.
        """
        attempts: dict[Future[FillAttempt], FillAttempt] = {}
        while waiting := {*futures} - attempts.keys():
            for future in self._pool.wait_for_any(waiting):
                attempts[future] = _find_ending(future)
            watch(len(attempts), len(futures))
        return attempts


def _find_ending(future: Future[FillAttempt]) -> FillAttempt:
    try:
        return future.result()
    except ProcessExpired as error:
        return FillAttempt(None, f"its worker died with exit code {error.exitcode}")


def _attempt_in_child(
    name: str,
    problem: Path,
    method: str,
    seconds: float,
    lasting: float,
    *,
    memory: int,
    seed: int,
    plugins: tuple[Path, ...],
) -> FillAttempt:
    """Return one attempt of so many seconds of work, made in a child of this process."""
    prepare = partial(load_plugins_once, plugins)
    prepare()
    model, calibration = MODELS.get(name), find_calibration(name)
    attempt = partial(
        _attempt_kept,
        seconds=min(seconds, LONGEST),
        seed=seed,
        method=method,
        calibration=calibration,
    )
    try:
        made: FillAttempt = call_in_child(
            attempt, model, problem, memory, timeout=lasting, prepare=prepare
        )
    except TimeoutError:
        made = FillAttempt(None, f"was stopped after {lasting:.3g} s", stopped=True)
    except ProcessDiedError as error:
        made = _explain_death(error.exit_code, seconds)
    finally:
        find_system().kill_children()  # what the model started and left running
    return made


def _explain_death(exit_code: int, seconds: float) -> FillAttempt:
    if find_system().is_end_of_work(exit_code):
        return FillAttempt(None, f"was stopped after {seconds:.3g} s of work", stopped=True)
    return FillAttempt(None, f"its process died with exit code {exit_code}")


def _attempt_kept(model: Any, path: Path, memory: int, **options: Any) -> FillAttempt:
    """Return the attempt at a problem of which all processes share one copy in memory."""
    return attempt_fill(model, joblib.load(path, mmap_mode="r"), memory, **options)
