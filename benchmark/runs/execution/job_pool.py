"""A pool of workers that live for many jobs, the model of each in a killable process.

A crash, a hang or a kill costs one record alone. A worker that dies is replaced.
"""

from __future__ import annotations

from collections.abc import Collection
from concurrent.futures import CancelledError, Future
from concurrent.futures.process import BrokenProcessPool

from pebble import ProcessExpired

from mocapbench.basics.system.choice import find_system
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.messages import reason
from mocapbench.benchmark.runs.execution.spool import Spool
from mocapbench.benchmark.runs.execution.worker import run_job
from mocapbench.benchmark.runs.execution.worker_context import UNGUARDED
from mocapbench.benchmark.runs.execution.worker_pool import WorkerPool
from mocapbench.benchmark.runs.job import Job, Outcome, Work, WorkerConfig

__all__ = ["JobPool"]

_GRACE = 120.0
"""Seconds beyond its time after which a job is killed from outside.

A worker ends itself in time where the system sees to it. Elsewhere a thread of it does, for which
code that is not Python may leave no chance to run. To start a job may take a minute: it imports.
"""


class JobPool:
    """Workers on this machine, started when the first job comes.

    Parameters
    ----------
    n_workers : int
        How many jobs run at once.
    config : WorkerConfig
    spool : Spool
        The recordings that jobs read.
    """

    def __init__(self, n_workers: int, config: WorkerConfig, spool: Spool) -> None:
        self._pool = WorkerPool(n_workers, timeout=config.timeout + _GRACE)
        self._config = config
        self._spool = spool

    def submit(self, work: Work) -> Future[Outcome]:
        """Have a worker run a job as soon as one is free."""
        return self._pool.submit(run_job, work, self._config, self._spool)

    def wait_for_any(self, futures: Collection[Future[Outcome]]) -> Collection[Future[Outcome]]:
        """Wait until one or more of ``futures`` have ended, and return them."""
        return self._pool.wait_for_any(futures)

    def outcome(self, future: Future[Outcome], job: Job) -> Outcome:
        """Return the job's outcome, or one that says why its worker gave none.

        Raises
        ------
        UsageError
            If no worker can start, since a script starts the run again in each.
        """
        try:
            return future.result()
        except BrokenProcessPool as error:
            raise UsageError(UNGUARDED) from error
        except ProcessExpired as error:
            if find_system().is_end_of_time(error.exitcode):
                return self._time_out(job)
            message = f"the worker died with exit code {error.exitcode} before it could report"
        except TimeoutError:
            return self._time_out(job)
        except (Exception, CancelledError) as error:
            message = f"no report came back: {reason(error)}"
        return Outcome.without_report(job, message)

    def _time_out(self, job: Job) -> Outcome:
        timeout = self._config.timeout
        return Outcome(job.timed_out(timeout), seconds=timeout)

    def stop(self, futures: Collection[Future[Outcome]]) -> None:
        """Kill the workers with what they run; the jobs of ``futures`` are cancelled."""
        self._pool.stop(futures)
