"""Jobs: one (task, case, fold, entrant) each, with the keys of what it computes; their outcomes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, Self

from mocapbench.benchmark.messages import reason, traceback_of
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.fitting.trained import Trained
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.task_files.task_file import TaskFile
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.seeds import Seeds

__all__ = ["Job", "Outcome", "Work", "WorkerConfig"]


@dataclass(frozen=True)
class WorkerConfig:
    """What the jobs of a run have in common; travels to the workers.

    Parameters
    ----------
    folders : tuple of Path
        Folders of recordings that the user names.
    plugins : tuple of Path
        The user's own files of models, tasks, metrics and libraries.
    timeout : float
        Seconds after which a job is killed.
    memory : float
        Bytes of address space that a job may take.
    threads : int
        Threads that a job may divide its work among; results do not depend on it.
    provenance : mapping of str to str
        Copied into every record.
    task_files : tuple of TaskFile
        The user's own tasks in TOML.
    """

    folders: tuple[Path, ...]
    plugins: tuple[Path, ...]
    timeout: float
    memory: float
    threads: int
    provenance: Mapping[str, str]
    task_files: tuple[TaskFile, ...] = ()


@dataclass(frozen=True)
class Job:
    """A unit of work, as plain values that travel to a worker.

    Parameters
    ----------
    address : Address
        The case, the fold and the entrant.
    seeds : Seeds
        The random streams of the problem, which cases may share.
    training_seeds : Seeds
        Those of the fit, which problems with the same training recordings may share.
    model, parameters : str, mapping
        What the entrant is.
    metrics : tuple of str
        What to score.
    key, fit_key : str
        Names of the record and of the predictions.
    training_key : str
        Name of the fitted model; empty if no other problem can use it.
    digests : mapping of str to str
        Digests of the recordings it reads.
    missing : tuple of str
        Addresses of the recordings that it needs and that are not at hand.
    parts : mapping of str to str
        What its keys cover, part by part; see ``key_parts``.
    """

    address: Address
    seeds: Seeds
    training_seeds: Seeds
    model: str
    parameters: Mapping[str, Any]
    metrics: tuple[str, ...]
    key: str
    fit_key: str
    training_key: str
    digests: Mapping[str, str]
    missing: tuple[str, ...] = ()
    parts: Mapping[str, str] = field(default_factory=dict)

    def record(self, status: Status, message: str = "", **results: Any) -> Record:
        """Return a record of this job that ended with ``status``."""
        return Record(
            key=self.key,
            fit_key=self.fit_key,
            address=self.address,
            seed=self.seeds.root,
            model=self.model,
            parameters=self.parameters,
            status=status,
            message=message,
            **results,
        )

    def record_failure(self, error: BaseException, memory: float) -> Record:
        """Return a record of this job, which may take ``memory`` bytes and raised ``error``."""
        text = traceback_of(error)
        match error:
            case MemoryError():
                said = f" ({error})" if str(error) else ""
                message = (
                    f"the job needed more than its {memory / 2**30:.1f} GiB; raise --memory or "
                    f"lower --jobs{said}"
                )
                return self.record(Status.OUT_OF_MEMORY, message, traceback=text)
            case TimeoutError():  # of a program that the model has run
                message = f"{error}; raise --timeout or lower the budget"
                return self.record(Status.TIMEOUT, message, traceback=text)
        return self.record(Status.FAILED, reason(error), traceback=text)

    def timed_out(self, seconds: float) -> Record:
        """Return a record of this job that was killed after so many seconds."""
        message = f"killed after {seconds:g} s; raise --timeout or lower the budget"
        return self.record(Status.TIMEOUT, message)


class Work(NamedTuple):
    """A job as it is handed to a worker."""

    job: Job
    fit: Fit | None
    """The predictions, where the store has them: then they are only scored."""
    remarks: tuple[str, ...] = ()
    """What the record is to say besides, such as that predictions were damaged."""
    trained: Trained | None = None
    """The fitted model, where another job has fitted it."""


class Outcome(NamedTuple):
    """What became of a job, and what of it is new."""

    record: Record
    fit: Fit | None = None
    """The predictions."""
    trained: Trained | None = None
    """The fitted model, where other jobs can use it."""
    seconds: float = 0.0
    """From when the worker took the job up."""

    @classmethod
    def without_report(cls, job: Job, message: str) -> Self:
        """Return the outcome of a job whose worker gave none, and why."""
        return cls(job.record(Status.FAILED, message))
