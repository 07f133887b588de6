"""A run: skip what the store holds, execute the rest, keep every record as it comes."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Sequence

from rich.console import Console

from mocapbench.benchmark.runs.job import Job, WorkerConfig
from mocapbench.benchmark.runs.pool import execute
from mocapbench.benchmark.runs.progress import watch
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.runs.store import Store
from mocapbench.datasets import Archive

__all__ = ["run"]


def run(
    jobs: Sequence[Job],
    store: Store,
    config: WorkerConfig,
    *,
    n_workers: int,
    console: Console,
) -> list[Record]:
    """Return the records of ``jobs``, in their order.

    A record that exists is not computed again, unless its job broke, in which case it is tried
    once more. Records are written as they come, so that an interrupted run loses nothing.

    Parameters
    ----------
    jobs : sequence of Job
    store : Store
    config : WorkerConfig
    n_workers : int
        How many jobs run at once.
    console : rich.console.Console
        Shows the progress.
    """
    known = {job.key: store.load(job.key) for job in jobs}
    finished = {key: record for key, record in known.items() if record and not record.status.broken}
    todo = [job for job in jobs if job.key not in finished]
    if finished:
        console.print(f"{len(finished)} of {len(jobs)} jobs are in {store.path} already")
    for record in watch(_records(todo, config, n_workers), len(todo), console):
        store.save(record)
        finished[record.key] = record
    return [finished[job.key] for job in jobs]


def _records(jobs: Sequence[Job], config: WorkerConfig, n_workers: int) -> Iterator[Record]:
    """Yield at once the jobs whose recordings cannot be had, then the others as they end."""
    for job in jobs:
        if job.missing:
            trials = " ".join(uri.removeprefix("cmu:") for uri in job.missing)
            plugins = "".join(f" --plugin {shlex.quote(str(path))}" for path in config.plugins)
            command = f"{Archive.fetch_command(*job.missing)}{plugins}"
            yield job.record(
                Status.DATA_MISSING,
                f"{trials} cannot be had: get it with `{command}`",
                provenance=config.provenance,
            )
    yield from execute([job for job in jobs if not job.missing], config, n_workers)
