"""Execution: jobs go to an executor in the order of their queue, and come back as they end."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from mocapbench.benchmark.runs.execution.base import Backend
from mocapbench.benchmark.runs.execution.job_queue import JobQueue
from mocapbench.benchmark.runs.execution.spool import Spool
from mocapbench.benchmark.runs.job import Job, Outcome, Work, WorkerConfig

__all__ = ["execute"]


def execute(
    queue: JobQueue,
    work: Callable[[Job], Work],
    config: WorkerConfig,
    spool: Spool,
    backend: Backend,
) -> Iterator[Outcome]:
    """Run the jobs of ``queue`` and yield each one's outcome as it ends.

    Closing the iterator, or an interrupt, kills what still runs.

    Parameters
    ----------
    queue : JobQueue
    work : callable
        Returns what a worker needs for a job; called shortly before the job starts.
    config : WorkerConfig
    spool : Spool
        The recordings that jobs read.
    backend : Backend
        Where they run.
    """
    executor = backend.start(config, spool)
    running: dict[Any, Work] = {}
    try:
        while True:
            # The backend holds as many again in wait, so that no worker waits for the store.
            while len(running) < 2 * backend.n_workers and (job := queue.take()):
                handed = work(job)
                running[executor.submit(handed)] = handed
            if not running:
                return
            for future in executor.wait_for_any(running.keys()):
                job, fit, *_ = running.pop(future)
                outcome = executor.outcome(future, job)
                queue.finish(job, outcome.seconds, rescored=fit is not None)
                yield outcome
    finally:
        executor.stop(running.keys())
