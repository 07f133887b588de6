"""What a run has on one dask worker: a folder, and processes that run its jobs."""

from __future__ import annotations

import multiprocessing
from collections.abc import Mapping
from concurrent.futures import CancelledError, Future
from dataclasses import replace
from pathlib import Path

from distributed import Reschedule

from mocapbench.benchmark.runs.cluster.plugin_files import write_plugin_files
from mocapbench.benchmark.runs.execution.job_pool import JobPool
from mocapbench.benchmark.runs.execution.spool import Spool
from mocapbench.benchmark.runs.job import Outcome, Work, WorkerConfig
from mocapbench.benchmark.runs.provenance import machine_facts

__all__ = ["WorkerState"]


class WorkerState:
    """The state of a run on one dask worker: recordings, plug-ins and a pool of processes.

    A dask worker has threads, from which no process may be forked; the pool's processes have one.

    Parameters
    ----------
    folder : Path
        A folder of its own.
    n_workers : int
        How many jobs run at once: the dask worker's threads.
    config : WorkerConfig
        Of the run; its paths are those of another machine.
    files : mapping of str to bytes
        What `read_plugin_files` returned.
    """

    def __init__(
        self, folder: Path, n_workers: int, config: WorkerConfig, files: Mapping[str, bytes]
    ) -> None:
        # Under its nanny a dask worker is a daemon, and daemons may not start processes. Ours end
        # with it all the same.
        multiprocessing.current_process().daemon = False
        self._spool = Spool(folder / "recordings")
        self._spool.folder.mkdir()
        config = replace(
            config,
            folders=(),
            plugins=write_plugin_files(files, config.plugins, folder / "plugins"),
            provenance={**config.provenance, **machine_facts()},
        )
        self._pool = JobPool(n_workers, config, self._spool)
        self._running: set[Future[Outcome]] = set()

    def run(self, work: Work, recordings: Mapping[str, bytes]) -> Outcome:
        """Return the outcome of a job, once a process of the pool has run it.

        Parameters
        ----------
        work : Work
        recordings : mapping of str to bytes
            The files of the run's spool that the job reads, by name.

        Raises
        ------
        Reschedule
            If the state is closed meanwhile: then another worker is to run the job.
        """
        for name, content in recordings.items():
            self._spool.receive(name, content)
        future = self._pool.submit(work)
        self._running.add(future)
        try:
            future.exception()  # waits
            return self._pool.outcome(future, work.job)
        except CancelledError:
            raise Reschedule from None
        finally:
            self._running.discard(future)

    def close(self) -> None:
        """Kill what runs."""
        self._pool.stop(tuple(self._running))
