"""Execution: every job in a killable process of its own.

A crash, a hang or a kill costs one record alone, and a job's peak memory is its own. Processes
are forked from a server that has the libraries loaded but has computed nothing.
"""

from __future__ import annotations

import multiprocessing
from collections.abc import Iterator, Sequence
from concurrent.futures import CancelledError, Future, as_completed

from pebble import CONSTS, ProcessExpired, ProcessPool

from mocapbench.benchmark.runs.evaluate import evaluate
from mocapbench.benchmark.runs.job import Job, WorkerConfig
from mocapbench.benchmark.runs.record import Record, Status

__all__ = ["execute"]

# How often the pool looks whether a worker has ended and the next may start, in seconds. A process
# a job, at pebble's tenth of a second an idle core would wait as long as most baselines compute.
CONSTS.sleep_unit = 0.01

_PRELOAD = [
    "mocapbench.benchmark.runs.evaluate",
    "scipy.interpolate",
    "scipy.optimize",
    "sklearn.impute",
]


def execute(jobs: Sequence[Job], config: WorkerConfig, n_workers: int) -> Iterator[Record]:
    """Run ``jobs`` and yield each one's record as it ends.

    Closing the iterator, or an interrupt, kills what still runs.

    Parameters
    ----------
    jobs : sequence of Job
    config : WorkerConfig
    n_workers : int
        How many jobs run at once.
    """
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(_PRELOAD)
    pool = ProcessPool(max_workers=n_workers, max_tasks=1, context=context)
    try:
        futures: dict[Future[Record], Job] = {
            pool.schedule(evaluate, args=[job, config], timeout=config.timeout): job for job in jobs
        }
        for future in as_completed(futures):
            yield _record(future, futures[future], config)
    finally:
        pool.stop()  # type: ignore[no-untyped-call]
        pool.join()


def _record(future: Future[Record], job: Job, config: WorkerConfig) -> Record:
    """Return the job's record, or one that says why its process gave none."""
    try:
        return future.result()
    except TimeoutError:
        message = (
            f"killed after {config.timeout:g} s, or exited without reporting; "
            "raise --timeout or lower the budget"
        )
        return job.record(Status.TIMEOUT, message)
    except ProcessExpired as error:
        message = f"the process died with exit code {error.exitcode} before it could report"
        return job.record(Status.FAILED, message)
    except (Exception, CancelledError) as error:
        return job.record(Status.FAILED, f"no report came back: {type(error).__name__}: {error}")
