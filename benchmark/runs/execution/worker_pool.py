"""Workers, forked from a server that has the libraries loaded."""

from __future__ import annotations

from pebble import ProcessPool

from mocapbench.benchmark.runs.execution.fork_server import fork_server
from mocapbench.benchmark.runs.execution.worker import prepare_worker

__all__ = ["worker_pool"]

_MOST_JOBS = 1000
"""After so many jobs a worker is replaced, and what its memory has grown by goes with it."""


def worker_pool(n_workers: int) -> ProcessPool:
    """Return a pool of that many workers, started when the first job comes.

    One that dies, or has done a thousand jobs, is replaced.
    """
    return ProcessPool(
        n_workers, max_tasks=_MOST_JOBS, context=fork_server(), initializer=prepare_worker
    )
