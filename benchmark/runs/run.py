"""A run: skip what the store holds, execute the rest, keep every record as it comes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from rich.console import Console

from mocapbench.basics.scratch import scratch_folder
from mocapbench.benchmark.archives import (
    advise_supply,
    archive_at,
    fetch_command,
    fetch_start,
    recording_names,
)
from mocapbench.benchmark.events import EventLog
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.execution.base import Backend
from mocapbench.benchmark.runs.execution.execute import execute
from mocapbench.benchmark.runs.execution.job_queue import JobQueue
from mocapbench.benchmark.runs.execution.spool import Spool
from mocapbench.benchmark.runs.fitting.trained import TrainedModels
from mocapbench.benchmark.runs.job import Job, Outcome, Work, WorkerConfig
from mocapbench.benchmark.runs.posed import PosedProblems
from mocapbench.benchmark.runs.progress import watch
from mocapbench.benchmark.runs.record import Record, Status

__all__ = ["run"]


def run(
    jobs: Sequence[Job],
    store: RunDirectory,
    config: WorkerConfig,
    *,
    backend: Backend,
    console: Console,
    log: EventLog | None = None,
) -> list[Record]:
    """Return the records of ``jobs``, in their order.

    A record that exists is not computed again, unless its job broke, in which case it is tried
    once more. A job that was posed another problem than the others of its fold has failed. Records
    and predictions are written as they come, so that an interrupted run loses nothing.

    Parameters
    ----------
    jobs : sequence of Job
    store : RunDirectory
    config : WorkerConfig
    backend : Backend
        Where jobs run, such as `ThisMachine`.
    console : rich.console.Console
        Shows the progress.
    log : EventLog, optional
        Records what happens.
    """
    log = log or EventLog()
    store.keep_keys({job.key: (job.address, job.parts) for job in jobs})
    posed = PosedProblems()
    known = {job.key: posed.check_record(r) for job in jobs if (r := store.load(job.key))}
    finished = {key: record for key, record in known.items() if not record.status.broken}
    todo = [job for job in jobs if job.key not in finished]
    log.tell_run_start(store.path, len(jobs), len(finished))
    if finished:
        console.print(f"{len(finished)} of {len(jobs)} jobs are in {store.path} already")
    missing = [job for job in todo if job.missing]
    finished |= {job.key: _record_missing(job, store, config, log) for job in missing}
    todo = [job for job in todo if not job.missing]
    if todo:  # or no worker starts
        queue = JobQueue(todo, finished.values())
        for record in _compute(queue, store, config, backend, console, log=log, posed=posed):
            finished[record.key] = record
    return [finished[job.key] for job in jobs]


def _record_missing(job: Job, store: RunDirectory, config: WorkerConfig, log: EventLog) -> Record:
    """Return the record of a job whose recordings are not here, once it is in the store."""
    record = _without_data(job, config)
    store.save(record)
    _log_end(log, record, 0.0)
    return record


def _compute(
    queue: JobQueue,
    store: RunDirectory,
    config: WorkerConfig,
    backend: Backend,
    console: Console,
    *,
    log: EventLog,
    posed: PosedProblems,
) -> Iterator[Record]:
    """Yield the record of each job as it ends, once it is in the store."""
    archive = archive_at(*config.folders)
    with scratch_folder() as folder:
        spool, models = Spool(folder), TrainedModels(folder)

        def work(job: Job) -> Work:
            spool.add(archive, job.digests)
            already_damaged = len(store.damaged)
            fit = store.load_fit(job.fit_key)
            log.tell_job_start(job.address)
            trained = models.load(job.training_key) if fit is None else None
            return Work(job, fit, tuple(store.damaged[already_damaged:]), trained)

        outcomes = map(partial(_check_outcome, posed), execute(queue, work, config, spool, backend))
        seconds_left = partial(queue.time_left, backend.n_workers)
        for outcome in watch(outcomes, queue.n_jobs, seconds_left, console):
            _save_outcome(outcome, store, models)
            _log_end(log, outcome.record, outcome.seconds)
            yield outcome.record


def _save_outcome(outcome: Outcome, store: RunDirectory, models: TrainedModels) -> None:
    """Keep what a job made; the record last, since it says that all else is there."""
    if outcome.fit is not None:
        store.save_fit(outcome.record.fit_key, outcome.fit)
    if outcome.trained is not None:
        models.save(outcome.trained)
    store.save(outcome.record)


def _check_outcome(posed: PosedProblems, outcome: Outcome) -> Outcome:
    """Return the outcome; without predictions if they are of another problem than expected."""
    record = posed.check_record(outcome.record)
    return outcome if record is outcome.record else outcome._replace(record=record, fit=None)


def _log_end(log: EventLog, record: Record, seconds: float) -> None:
    log.tell_job_end(record.address, record.status.value, seconds, record.message)


def _without_data(job: Job, config: WorkerConfig) -> Record:
    """Return the record of a job whose recordings are not here."""
    names, archive = recording_names(job.missing), archive_at(*config.folders)
    lost = f"not on this machine: {', '.join(names)}"
    if supply := advise_supply(job.missing, archive):  # no command gets them
        text = f"{lost}; {'; '.join(supply)}"
        return job.record(Status.DATA_MISSING, text, provenance=config.provenance)
    those, command = "it" if len(names) == 1 else "them", fetch_command(job.missing, config.plugins)
    return job.record(
        Status.DATA_MISSING,
        f"{lost}; get {those} with `{command}`",
        missing=names,
        fetch=fetch_start(config.plugins),
        provenance=config.provenance,
    )
