"""Jobs run on this machine."""

from __future__ import annotations

from contextlib import AbstractContextManager

from mocapbench.benchmark.runs.execution.base import Executor
from mocapbench.benchmark.runs.execution.spool import Spool
from mocapbench.benchmark.runs.job import WorkerConfig
from mocapbench.benchmark.runs.machine import memory_share

__all__ = ["ThisMachine"]


class ThisMachine(AbstractContextManager["ThisMachine"]):
    """The machine that the run is started on.

    Parameters
    ----------
    n_workers : int
        How many jobs run at once.
    """

    def __init__(self, n_workers: int) -> None:
        self.n_workers = n_workers

    @property
    def memory(self) -> float:
        """The GiB that fall to one job."""
        return memory_share(self.n_workers)

    def start(self, config: WorkerConfig, spool: Spool) -> Executor:
        """Return a pool of workers for one run."""
        # Imported where it is used: who resumes a finished run starts no worker.
        from mocapbench.benchmark.runs.execution.job_pool import JobPool  # noqa: PLC0415

        return JobPool(self.n_workers, config, spool)

    def __exit__(self, *_: object) -> None:
        """Release nothing: the workers end with their run."""
