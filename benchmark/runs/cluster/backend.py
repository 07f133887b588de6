"""A dask cluster as a place where jobs run."""

from __future__ import annotations

import time
from contextlib import AbstractContextManager, ExitStack

from distributed import Client, Worker

from mocapbench.benchmark.runs.cluster.executor import ClusterExecutor
from mocapbench.benchmark.runs.execution.spool import Spool
from mocapbench.benchmark.runs.job import WorkerConfig
from mocapbench.benchmark.runs.machine import MINIMUM_MEMORY, memory_share

__all__ = ["ClusterBackend"]

_LOOK_AROUND = 5.0
"""Seconds for which the number of workers is taken to stay as it is."""


class ClusterBackend(AbstractContextManager["ClusterBackend"]):
    """The workers of a scheduler, of which each runs as many jobs at once as it has threads.

    Parameters
    ----------
    client : Client
        Connected to the scheduler.
    held : ExitStack
        What ends with the backend.
    """

    def __init__(self, client: Client, held: ExitStack) -> None:
        self._client = client
        self._held = held
        self._counted, self._n_workers = float("-inf"), 1

    @property
    def n_workers(self) -> int:
        """How many jobs run at once at present; one if no worker is left, for one may come."""
        if time.monotonic() - self._counted > _LOOK_AROUND:
            self._n_workers = max(1, sum(self._client.nthreads().values()))
            self._counted = time.monotonic()
        return self._n_workers

    @property
    def memory(self) -> float:
        """The GiB that fall to one job, on the worker that has the least."""
        found = self._client.run(_room, on_error="ignore").values()  # not of workers just gone
        rooms = [room for room in found if room is not None]
        return max(MINIMUM_MEMORY, min(rooms)) if rooms else memory_share(self.n_workers)

    def start(self, config: WorkerConfig, spool: Spool) -> ClusterExecutor:
        """Return an executor for one run."""
        return ClusterExecutor(self._client, config, spool)

    def __exit__(self, *_: object) -> None:
        """Disconnect, and end what was started for this backend."""
        self._held.close()


def _room(dask_worker: Worker) -> float | None:
    """Return the GiB of a worker that fall to one of its threads; None if it has no limit."""
    limit = dask_worker.memory_manager.memory_limit
    return limit / 2**30 / dask_worker.state.nthreads if limit else None
