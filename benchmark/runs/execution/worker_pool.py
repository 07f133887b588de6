"""Workers, which start when the first job comes."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Collection
from concurrent.futures import FIRST_COMPLETED, Future, wait
from multiprocessing.context import BaseContext
from typing import Any

from pebble import ProcessExpired, ProcessPool
from pebble.common.types import Result, ResultStatus
from pebble.pool.base_pool import Task
from pebble.pool.process import PoolManager, TaskManager

from mocapbench.benchmark.runs.execution.interrupts import interrupts_later
from mocapbench.benchmark.runs.execution.worker import prepare_worker
from mocapbench.benchmark.runs.execution.worker_context import worker_context

__all__ = ["WorkerPool"]

_MOST_JOBS = 1000
"""After so many jobs a worker is replaced, and what its memory has grown by goes with it."""
_PATIENCE = 0.2
"""Seconds that an interrupt waits at most while jobs run."""
_LOOKS = 50
"""Looks, a tenth of a second apart, after which a job whose worker has ended is given up."""


class _Jobs(TaskManager):
    """Pebble's, by a clock that never jumps."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self._since: dict[int, float] = {}

    def timeout_tasks(self) -> tuple[Task, ...]:
        """Return jobs that have lasted for longer than they may since they were seen to run."""
        now = time.monotonic()
        tasks = self.tasks.copy().values()
        running = [(task, task.timeout) for task in tasks if task.timeout and task.started]
        self._since = {task.id: self._since.get(task.id, now) for task, _ in running}
        return tuple(task for task, most in running if now - self._since[task.id] > most)


class _Manager(PoolManager):
    """Pebble's, which takes an exit code of 0 for the end of a worker that has done its jobs.

    One that exits in the midst of a job has exit code 0, too, if the job says so. The result of a
    worker's last job may come a moment after the worker has ended, so that it takes some looks.
    """

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.task_manager = _Jobs(self.context.task_queue.task_done)
        self._looks: Counter[int] = Counter()

    def update_status(self) -> None:
        """Do what pebble does again and again, and end jobs whose workers have ended."""
        super().update_status()  # type: ignore[no-untyped-call]
        workers = self.worker_manager.workers
        tasks = [*self.task_manager.tasks.copy().values()]
        left = [task for task in tasks if task.worker_id and task.worker_id not in workers]
        self._looks = Counter({task.id: self._looks[task.id] + 1 for task in left})
        for task in left:
            if self._looks[task.id] >= _LOOKS:
                error = ProcessExpired("ended in a job", 0, task.worker_id)  # type: ignore[no-untyped-call]
                self.task_manager.task_done(task.id, Result(ResultStatus.ERROR, error))


class _Pool(ProcessPool):
    """Pebble's, with our manager."""

    def __init__(self, max_workers: int, **options: Any) -> None:
        super().__init__(max_workers, **options)
        self._pool_manager = _Manager(self._context, options["context"])


class WorkerPool:
    """Workers, started when the first job comes.

    One that dies, or has done a thousand jobs, is replaced. An interrupt strikes between the
    methods, not within them, so that `stop` ends whatever was interrupted.

    Parameters
    ----------
    n_workers : int
        How many jobs run at once.
    start : callable, optional
        Returns the context in which workers start.
    timeout : float, optional
        Seconds after which a job is killed with its worker, and ends with `TimeoutError`.
    """

    def __init__(
        self,
        n_workers: int,
        start: Callable[[], BaseContext] = worker_context,
        timeout: float | None = None,
    ) -> None:
        self._timeout = timeout
        self._pool = _Pool(
            n_workers, max_tasks=_MOST_JOBS, context=start(), initializer=prepare_worker
        )

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Have a worker call a function as soon as one is free."""
        with interrupts_later():
            return self._pool.schedule(function, arguments, timeout=self._timeout)

    def wait_for_any(self, futures: Collection[Future[Any]]) -> Collection[Future[Any]]:
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
