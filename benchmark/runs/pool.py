"""Execution: workers that live for many jobs, each of which runs in a killable process.

A crash, a hang or a kill costs one record alone. Workers are forked from a server that has the
libraries loaded but has computed nothing, and one that dies is replaced.
"""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait

from pebble import ProcessExpired, ProcessPool

from mocapbench.benchmark.runs.job import Job, Outcome, Work, WorkerConfig
from mocapbench.benchmark.runs.job_queue import JobQueue
from mocapbench.benchmark.runs.record import Status
from mocapbench.benchmark.runs.spool import Spool
from mocapbench.benchmark.runs.worker import prepare_worker, run_job

__all__ = ["execute"]

_PRELOAD = [
    "mocapbench.benchmark.runs.worker",
    "scipy.interpolate",
    "scipy.optimize",
    "sklearn.impute",
]


def execute(
    queue: JobQueue,
    work: Callable[[Job], Work],
    config: WorkerConfig,
    spool: Spool,
    n_workers: int,
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
    n_workers : int
        How many jobs run at once.
    """
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(_PRELOAD)
    pool = ProcessPool(max_workers=n_workers, context=context, initializer=prepare_worker)
    running: dict[Future[Outcome], Job] = {}
    try:
        while True:
            # As many again wait in the pool, so that no worker waits for the store.
            while len(running) < 2 * n_workers and (job := queue.take()):
                arguments = (work(job), config, spool)
                running[pool.schedule(run_job, arguments)] = job
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                job = running.pop(future)
                outcome = _outcome(future, job)
                queue.ended(job, outcome.seconds)
                yield outcome
    finally:
        pool.stop()  # type: ignore[no-untyped-call]
        pool.join()


def _outcome(future: Future[Outcome], job: Job) -> Outcome:
    """Return the job's outcome, or one that says why its worker gave none."""
    try:
        return future.result()
    except ProcessExpired as error:
        message = f"the worker died with exit code {error.exitcode} before it could report"
        return Outcome(job.record(Status.FAILED, message), None, 0.0)
    except (Exception, CancelledError) as error:
        message = f"no report came back: {type(error).__name__}: {error}"
        return Outcome(job.record(Status.FAILED, message), None, 0.0)
