"""What a run brings to every dask worker, those that join later included."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import cast

from distributed import Reschedule, Worker, WorkerPlugin, get_worker

from mocapbench.basics.temporaries import temporary_folder
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.cluster.installation import difference, installation
from mocapbench.benchmark.runs.cluster.worker_state import WorkerState
from mocapbench.benchmark.runs.job import Outcome, Work, WorkerConfig

__all__ = ["RunPlugin", "run_on_worker"]


class RunPlugin(WorkerPlugin):
    """Gives each dask worker the state that the run keeps there.

    Parameters
    ----------
    name : str
        A name that no other run has.
    config : WorkerConfig
    files : mapping of str to bytes
        What `read_plugin_files` returned.
    expected : mapping of str to str
        The installation that a worker must have.
    """

    def __init__(
        self,
        name: str,
        config: WorkerConfig,
        files: Mapping[str, bytes],
        expected: Mapping[str, str],
    ) -> None:
        self.name = name
        self._config = config
        self._files = files
        self._expected = expected
        self._state: WorkerState | None = None
        self._refusal = "could not prepare for the run; its log says why"

    def setup(self, worker: Worker) -> None:
        """Prepare the worker for jobs, if it has what they need."""
        self._refusal = difference(self._expected, installation())
        if not self._refusal:
            self._held = ExitStack()
            folder = self._held.enter_context(temporary_folder(Path(worker.local_directory)))
            self._state = WorkerState(folder, worker.state.nthreads, self._config, self._files)

    def teardown(self, worker: Worker) -> None:
        """End what runs here and remove what was written."""
        del worker
        if self._state:
            self._state.close()
            self._held.close()

    def run(self, worker: Worker, work: Work, recordings: Mapping[str, bytes]) -> Outcome:
        """Return the outcome of a job.

        Raises
        ------
        UsageError
            If the worker cannot run jobs of this run.
        """
        if self._state is None:
            raise UsageError(f"worker {worker.address}: {self._refusal}")
        return self._state.run(work, recordings)


def run_on_worker(
    run: str, work: Work, recordings: Mapping[str, bytes], unreadable: Sequence[str]
) -> Outcome:
    """Return the outcome of a job on the dask worker that calls this.

    Parameters
    ----------
    run : str
        The name of the run's plug-in.
    work : Work
    recordings : mapping of str to bytes
        The files of the run's spool that the job reads, by name.
    unreadable : sequence of str
        Why recordings that the job needs could not be read where the run started.
    """
    if unreadable:
        return Outcome.without_report(work.job, unreadable[0])
    worker = get_worker()
    plugin = cast(RunPlugin | None, worker.plugins.get(run))
    if plugin is None:  # the worker is closing, and has let go of its plug-ins
        raise Reschedule
    return plugin.run(worker, work, recordings)
