"""The process from which workers are forked: it loads the libraries once, and computes nothing."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import forkserver, resource_tracker
from multiprocessing.context import BaseContext

from mocapbench.benchmark.errors import UsageError

__all__ = ["UNGUARDED", "fork_server"]

UNGUARDED = (
    "expected workers to start, got a script that starts the run again in each of them; put what "
    'it does below `if __name__ == "__main__":`'
)

_PRELOAD = [
    "mocapbench.benchmark.runs.execution.worker",
    "scipy.interpolate",
    "scipy.optimize",
    "sklearn.impute",
]
_ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""Workers compute with one thread; a pool of threads that never work would slow every fork."""


def fork_server() -> BaseContext:
    """Start the server unless it runs, and return the context of processes forked from it.

    It takes a second or two to load the libraries, while this process goes on.

    Raises
    ------
    UsageError
        If a worker reads a script that starts a run wherever it is read.
    """
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(_PRELOAD)
    with _environment(_ONE_THREAD), _without_interrupts():
        _ensure_running()
    return context


def _ensure_running() -> None:
    try:
        forkserver.ensure_running()
    except RuntimeError:  # this process is starting itself, and reads the user's script again
        raise UsageError(UNGUARDED) from None


@contextmanager
def _environment(variables: dict[str, str]) -> Iterator[None]:
    """Let processes that start within the context have these environment variables."""
    before = {name: os.environ[name] for name in variables if name in os.environ}
    os.environ.update(variables)
    try:
        yield
    finally:
        for name in variables:
            del os.environ[name]
        os.environ.update(before)


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Let processes that start within the context not hear of Ctrl-C, which is for this one."""
    resource_tracker.ensure_running()  # by the server's start at the latest; it would let them in
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
