"""How processes start: without the current folder on their path, with one thread, unheard."""

from __future__ import annotations

import _thread
import os
import signal
import sys
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from types import ModuleType

__all__ = [
    "ONE_THREAD",
    "SAFE_PATH",
    "change_environment",
    "forget_safe_path",
    "hide_script",
    "hold_interrupts",
    "list_signals",
    "strike_main_thread",
]

ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""Workers compute with one thread; a pool of threads that never work would slow every fork."""
SAFE_PATH = {"PYTHONSAFEPATH": "mocapbench"}
"""Has Python start without the current folder on its path.

There it looks first for what `multiprocessing` imports, so that a file random.py beside the data
would be run. Any text has this effect; ours tells who set it.
"""
_ENVIRONMENT_LOCK = threading.Lock()


@contextmanager
def hide_script() -> Iterator[None]:
    """Let `multiprocessing`, which has new processes read the main module, find an empty one."""
    script = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = script


@contextmanager
def change_environment(variables: Mapping[str, str]) -> Iterator[None]:
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
def hold_interrupts() -> Iterator[None]:
    """Let processes that start within the context not hear of Ctrl-C, which is for this one.

    Windows has no masks of signals: there they hear of it until they ignore it.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def list_signals(*names: str) -> list[signal.Signals]:
    """Return those signals that the system has: Windows has no SIGHUP."""
    return [signal.Signals[name] for name in names if name in signal.Signals.__members__]


def strike_main_thread(number: int) -> None:
    """Have a signal handled by the main thread, which it wakes if the system can do so."""
    if hasattr(signal, "pthread_kill"):  # not on Windows
        signal.pthread_kill(threading.main_thread().ident or 0, number)
    else:
        _thread.interrupt_main(signal.Signals(number))
