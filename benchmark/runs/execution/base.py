"""Where jobs run, as a run sees it: a backend, and the executor that it starts for one run."""

from __future__ import annotations

from collections.abc import Collection
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from mocapbench.benchmark.runs.execution.spool import Spool
    from mocapbench.benchmark.runs.job import Job, Outcome, Work, WorkerConfig

__all__ = ["Backend", "Executor"]


class Executor(Protocol):
    """Takes the jobs of one run; a future stands for a job that it has taken."""

    def submit(self, work: Work) -> Any:
        """Have a worker run a job as soon as one is free, and return its future."""

    def wait_for_any(self, futures: Collection[Any]) -> Collection[Any]:
        """Wait until one or more of ``futures`` have ended, or for a while, and return these."""

    def outcome(self, future: Any, job: Job) -> Outcome:
        """Return the outcome of a job that has ended."""

    def stop(self, futures: Collection[Any]) -> None:
        """Kill the workers with what they run; the jobs of ``futures`` are cancelled."""


class Backend(AbstractContextManager["Backend"], Protocol):
    """Where jobs run; what it holds is released when its context ends."""

    @property
    def n_workers(self) -> int:
        """How many jobs run at once at present."""

    @property
    def memory(self) -> float:
        """The GiB that fall to one job."""

    def start(self, config: WorkerConfig, spool: Spool) -> Executor:
        """Return an executor for one run."""
