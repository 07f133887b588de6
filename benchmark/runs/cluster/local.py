"""A cluster that is started on this machine for one run."""

from __future__ import annotations

import logging
import signal
from contextlib import ExitStack

import dask
from distributed import Client, LocalCluster, Worker, WorkerPlugin

from mocapbench.basics.scratch import process_folder
from mocapbench.basics.system.starting import SAFE_PATH, change_environment
from mocapbench.benchmark.runs.cluster.admission import require_workers
from mocapbench.benchmark.runs.cluster.backend import ClusterBackend

__all__ = ["open_backend"]

_SAFE = {f"distributed.nanny.pre-spawn-environ.{name}": text for name, text in SAFE_PATH.items()}


def open_backend(kind: str) -> ClusterBackend:
    """Start a cluster of workers with one thread each, reachable from this machine alone.

    Parameters
    ----------
    kind : str
        ``local:N`` for N workers.
    """
    with ExitStack() as held:
        cluster = held.enter_context(_cluster(int(kind.partition(":")[2])))
        client = held.enter_context(Client(cluster))
        client.register_plugin(_Undisturbed())
        require_workers(client)
        return ClusterBackend(client, held.pop_all())


def _cluster(n_workers: int) -> LocalCluster:
    # The configuration is for workers that are started again, the environment for what else starts.
    with dask.config.set(_SAFE), change_environment(SAFE_PATH):
        return LocalCluster(
            n_workers=n_workers,
            threads_per_worker=1,
            host="127.0.0.1",
            dashboard_address="127.0.0.1:0",
            local_directory=str(process_folder()),
            memory_limit=0,  # jobs have their own limit, and their processes are not the worker's
            silence_logs=logging.ERROR,
        )


class _Undisturbed(WorkerPlugin):
    """Leaves an interrupt, which a terminal sends to all processes, to the one that ends them."""

    def setup(self, worker: Worker) -> None:
        del worker
        signal.signal(signal.SIGINT, signal.SIG_IGN)
