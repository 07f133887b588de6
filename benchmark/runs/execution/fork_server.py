"""The process from which workers are forked: it loads the libraries once, and computes nothing."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from multiprocessing import forkserver, resource_tracker
from multiprocessing.context import BaseContext, ForkServerContext, ForkServerProcess
from multiprocessing.process import BaseProcess, current_process
from types import ModuleType
from typing import Any

from mocapbench.basics.scratch import process_folder
from mocapbench.benchmark.errors import UsageError

__all__ = [
    "SAFE_PATH",
    "UNGUARDED",
    "environment",
    "forget_safe_path",
    "fork_server",
    "fork_server_without_script",
]

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
SAFE_PATH = {"PYTHONSAFEPATH": "mocapbench"}
"""Has Python start without the current folder on its path.

There it looks first for what `multiprocessing` imports, so that a file random.py beside the data
would be run. Any text has this effect; ours tells who set it.
"""
_LONGEST_FOLDER = 107 - len("/listener-12345678")
"""In bytes, of one for sockets, whose paths may have 107."""
_ENVIRONMENT_LOCK = threading.Lock()


class _Process(ForkServerProcess):
    """A process forked from our server, which is started again if it has died."""

    @staticmethod
    def _Popen(process_obj: BaseProcess) -> Any:  # noqa: N802
        _ensure_running()
        return ForkServerProcess._Popen(process_obj)


class _Context(ForkServerContext):
    Process = _Process


class _ProcessWithoutScript(_Process):
    """A process that does not read the script which starts it."""

    @staticmethod
    def _Popen(process_obj: BaseProcess) -> Any:  # noqa: N802
        with _hide_script():
            return _Process._Popen(process_obj)


class _ContextWithoutScript(ForkServerContext):
    Process = _ProcessWithoutScript


def fork_server() -> BaseContext:
    """Start the server unless it runs, and return the context of processes forked from it.

    It takes a second or two to load the libraries, while this process goes on.

    Raises
    ------
    UsageError
        If a worker reads a script that starts a run wherever it is read.
    """
    try:
        _ensure_running()
    except RuntimeError:  # this process is starting itself, and reads the user's script again
        raise UsageError(UNGUARDED) from None
    return _Context()


def fork_server_without_script() -> BaseContext:
    """Return the context of processes that do not read the user's script, as `fork_server`.

    They find nothing that the script defines. It may be a notebook or come from standard input, and
    need not guard what it does by ``if __name__ == "__main__":``.
    """
    _ensure_running()
    return _ContextWithoutScript()


@contextmanager
def _hide_script() -> Iterator[None]:
    """Let `multiprocessing`, which has new processes read the main module, find an empty one."""
    script = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = script


def _ensure_running() -> None:
    multiprocessing.set_forkserver_preload(_PRELOAD)
    temporary = {"TMPDIR": _keep_sockets_in_own_folder()}
    with environment(_ONE_THREAD | SAFE_PATH | temporary), _without_interrupts():
        forkserver.ensure_running()


def _keep_sockets_in_own_folder() -> str:
    """Return our folder, and have `multiprocessing` use it unless it has made one of its own.

    Its own stays if this process is killed, as does what a model keeps in one when it is.
    """
    folder = str(process_folder())
    if len(os.fsencode(folder)) <= _LONGEST_FOLDER:
        current_process()._config.setdefault("tempdir", folder)  # type: ignore[attr-defined]
    return folder


@contextmanager
def environment(variables: Mapping[str, str]) -> Iterator[None]:
    """Let processes that start within the context have these environment variables."""
    with _ENVIRONMENT_LOCK:  # pools start workers from threads of theirs
        before = {name: os.environ[name] for name in variables if name in os.environ}
        os.environ.update(variables)
        try:
            yield
        finally:
            for name in variables:
                del os.environ[name]
            os.environ.update(before)


def forget_safe_path() -> None:
    """Let programs that this process starts import from their own folder, unless the user forbids.

    Those of a model do: a script finds its helpers beside it.
    """
    for name, value in SAFE_PATH.items():
        if os.environ.get(name) == value:
            del os.environ[name]


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Let processes that start within the context not hear of Ctrl-C, which is for this one."""
    resource_tracker.ensure_running()  # by the server's start at the latest; it would let them in
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
