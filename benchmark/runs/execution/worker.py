"""One worker: it lives for many jobs, and gives the model of each a process of its own.

It poses the problems and scores the answers. A child, which shares its memory, fits and answers:
what a model does to its process reaches no other job, nor what scores it.
"""

from __future__ import annotations

import gc
import time
from collections.abc import Mapping
from contextlib import suppress
from functools import cache, partial
from pathlib import Path

from threadpoolctl import threadpool_limits

from mocapbench.basics.child import ProcessDiedError
from mocapbench.basics.system.choice import find_system
from mocapbench.basics.system.starting import forget_safe_path
from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.plugins import load_plugins
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.benchmark.runs.evaluate import evaluate
from mocapbench.benchmark.runs.execution.spool import Spool, SpooledArchive
from mocapbench.benchmark.runs.execution.time_limit import TimeLimit
from mocapbench.benchmark.runs.job import Outcome, Work, WorkerConfig
from mocapbench.benchmark.runs.record import Status
from mocapbench.benchmark.task_files.building import add_tasks
from mocapbench.benchmark.task_files.task_file import TaskFile
from mocapbench.datasets import Library

__all__ = ["load_plugins_once", "prepare_worker", "run_job"]


def prepare_worker() -> None:
    """Make this process a worker: it ends with its parent and computes with one thread."""
    forget_safe_path()
    # One BLAS thread, so that results do not depend on how many jobs run at once.
    threadpool_limits(1)
    gc.freeze()  # what the libraries hold lives as long as the worker
    find_system().become_worker()


def run_job(work: Work, config: WorkerConfig, spool: Spool) -> Outcome:
    """Return the outcome of one job; whatever its model does becomes a failed record.

    A task or a metric that takes too long ends the worker.

    Parameters
    ----------
    work : Work
    config : WorkerConfig
    spool : Spool
        The recordings that the run has read.
    """
    job, started = work.job, time.perf_counter()
    prepare = partial(_register_all, config.folders, config.plugins, config.task_files)
    libraries = prepare()
    _import_code(job.model, job.address.task, job.metrics)
    archive = SpooledArchive(libraries, spool, job.digests)
    try:
        with TimeLimit(config.timeout) as limit:
            ended = evaluate(work, config, archive, partial(limit.call_in_child, prepare=prepare))
    except TimeoutError:
        ended = Outcome(job.timed_out(config.timeout))
    except MemoryError as error:  # where there is no room for what the child hands back
        ended = Outcome(job.record_failure(error, config.memory))
    except ProcessDiedError as error:
        message = f"the process died with exit code {error.exit_code} before it could report"
        ended = Outcome(job.record(Status.FAILED, message))
    finally:
        find_system().kill_children()  # what the job started and left running
    return ended._replace(seconds=time.perf_counter() - started)


@cache
def load_plugins_once(paths: tuple[Path, ...]) -> None:
    """Register what the user's own files define, where this process has not done so."""
    load_plugins(paths)


def _register_all(
    folders: tuple[Path, ...], plugins: tuple[Path, ...], task_files: tuple[TaskFile, ...]
) -> Mapping[str, Library]:
    """Register what is the user's own, where that is not so, and return the libraries."""
    libraries = _libraries(folders, plugins)
    _add_tasks(task_files)
    return libraries


@cache
def _add_tasks(files: tuple[TaskFile, ...]) -> None:
    add_tasks(files)


@cache
def _libraries(folders: tuple[Path, ...], plugins: tuple[Path, ...]) -> Mapping[str, Library]:
    """Load the plug-ins, and return the libraries of recordings, theirs included."""
    load_plugins_once(plugins)
    return archive_at(*folders).libraries


@cache
def _import_code(model: str, task: str, metrics: tuple[str, ...]) -> None:
    """Import what every child would import again; of what fails, `evaluate` gives the reason."""
    with suppress(Exception):
        TASKS.get(task)
        MODELS.get(model)
        list(map(METRICS.get, metrics))
    # What lives as long as the worker is not garbage; to look for garbage there would copy that
    # memory into every child.
    gc.freeze()
