"""Workers, forked from a server that has the libraries loaded."""

from __future__ import annotations

from collections.abc import Callable, Collection
from concurrent.futures import FIRST_COMPLETED, Future, wait
from typing import Any

from pebble import ProcessPool

from mocapbench.benchmark.runs.execution.fork_server import fork_server
from mocapbench.benchmark.runs.execution.interrupts import interrupts_later
from mocapbench.benchmark.runs.execution.worker import prepare_worker

__all__ = ["WorkerPool"]

_MOST_JOBS = 1000
"""After so many jobs a worker is replaced, and what its memory has grown by goes with it."""
_PATIENCE = 0.2
"""Seconds that an interrupt waits at most while jobs run."""


class WorkerPool:
    """Workers, started when the first job comes.

    One that dies, or has done a thousand jobs, is replaced. An interrupt strikes between the
    methods, not within them, so that `stop` ends whatever was interrupted.

    Parameters
    ----------
    n_workers : int
        How many jobs run at once.
    """

    def __init__(self, n_workers: int) -> None:
        self._pool = ProcessPool(
            n_workers, max_tasks=_MOST_JOBS, context=fork_server(), initializer=prepare_worker
        )

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Have a worker call a function as soon as one is free."""
        with interrupts_later():
            return self._pool.schedule(function, arguments)

    def ended(self, futures: Collection[Future[Any]]) -> Collection[Future[Any]]:
        """Wait until one or more of ``futures`` have ended, and return them."""
        ended: Collection[Future[Any]] = ()
        while futures and not ended:
            with interrupts_later():
                ended = wait(futures, _PATIENCE, FIRST_COMPLETED).done
        return ended

    def stop(self, futures: Collection[Future[Any]] = ()) -> None:
        """Kill the workers with what they run; the jobs of ``futures`` are cancelled."""
        with interrupts_later():
            for future in futures:
                future.cancel()
            self._pool.stop()  # type: ignore[no-untyped-call]
            self._pool.join()
