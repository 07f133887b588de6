"""The jobs of one run, submitted to a dask scheduler."""

from __future__ import annotations

import uuid
from collections.abc import Collection
from contextlib import suppress
from pathlib import Path

from distributed import CancelledError, Client, Future, KilledWorker, wait

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.messages import reason
from mocapbench.benchmark.runs.cluster.client_watch import ClientWatch
from mocapbench.benchmark.runs.cluster.installation import installation
from mocapbench.benchmark.runs.cluster.plugin_files import read_plugin_files
from mocapbench.benchmark.runs.cluster.run_plugin import RunPlugin, run_on_worker
from mocapbench.benchmark.runs.execution.spool import Spool
from mocapbench.benchmark.runs.job import Job, Outcome, Work, WorkerConfig

__all__ = ["ClusterExecutor"]

_LOOK_AROUND = 5.0
"""Seconds after which new workers get jobs, even if no job has ended."""
_TRIES = 4
"""How often in a row a worker may die while it is given what a run brings."""


class ClusterExecutor:
    """Sends jobs to the cluster, and what they need before them.

    Parameters
    ----------
    client : Client
    config : WorkerConfig
    spool : Spool
        The recordings that the run has read.
    """

    def __init__(self, client: Client, config: WorkerConfig, spool: Spool) -> None:
        self._client = client
        self._spool = spool
        self._recordings: dict[str, Future[bytes]] = {}
        name, files = f"mocapbench-{uuid.uuid4().hex}", read_plugin_files(config.plugins)
        self._plugin = RunPlugin(name, config, files, installation())
        client.register_plugin(ClientWatch(client.id, name))
        _bring(self._plugin, client)

    def submit(self, work: Work) -> Future[Outcome]:
        """Have a worker run a job as soon as one is free."""
        digests = work.job.digests
        recordings = {path.name: self._recording(path) for path in self._spool.files(digests)}
        return self._client.submit(
            run_on_worker,
            self._plugin.name,
            work,
            recordings,
            self._spool.unreadable(digests),
            key=f"{work.job.address.label}-{self._plugin.name}-{work.job.key}",
        )

    def _recording(self, path: Path) -> Future[bytes]:
        """Send a recording to the cluster once; a worker gets it from another that has it."""
        if path.name not in self._recordings:
            # A task rather than scattered data: when the workers that have it die, it comes again.
            self._recordings[path.name] = self._client.submit(
                bytes, path.read_bytes(), key=f"recording-{path.name}"
            )
        return self._recordings[path.name]

    def wait_for_any(self, futures: Collection[Future[Outcome]]) -> Collection[Future[Outcome]]:
        """Wait until one or more of ``futures`` have ended, or for a while, and return these.

        Raises
        ------
        UsageError
            If the cluster has lost them.
        """
        try:
            with suppress(TimeoutError), self._client.as_current():
                wait(list(futures), timeout=_LOOK_AROUND, return_when="FIRST_COMPLETED")
        except CancelledError as error:
            raise UsageError(
                "expected the scheduler to keep the jobs of this run, got a lost connection or a "
                "restart; see that it runs, and give the same command, which resumes"
            ) from error
        return [future for future in futures if future.done()]

    def outcome(self, future: Future[Outcome], job: Job) -> Outcome:
        """Return the job's outcome, or one that says why no worker gave one.

        Raises
        ------
        UsageError
            If a worker is not fit for this run.
        """
        match future.exception():
            case None:
                return future.result()
            case UsageError() as error:
                raise error
            case KilledWorker() as error:
                message = (
                    f"{error.allowed_failures + 1} workers died while they had the job, the last "
                    f"of them {error.last_worker.address}; its log may say why"
                )
            case error:
                message = f"no report came back: {reason(error)}"
        return Outcome.without_report(job, message)

    def stop(self, futures: Collection[Future[Outcome]]) -> None:
        """Kill what the cluster runs for this run; the jobs of ``futures`` are cancelled."""
        with suppress(Exception):  # of a scheduler that is gone, nothing is left to stop
            self._client.cancel(list(futures), force=True)
            self._client.unregister_worker_plugin(self._plugin.name)


def _bring(plugin: RunPlugin, client: Client) -> None:
    """Give every worker what a run brings; if one dies meanwhile, give it again to the others."""
    for _ in range(_TRIES - 1):
        with suppress(OSError):
            client.register_plugin(plugin)
            return
    client.register_plugin(plugin)
