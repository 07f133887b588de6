"""A call in a process of its own: its crash, hang or kill costs this call alone.

The process is forked from one that has loaded what the call needs, which takes milliseconds. What
the call changes in its process ends with it, and its peak memory is its own.
"""

from __future__ import annotations

import ctypes
import multiprocessing
import os
import pickle
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkProcess
from pathlib import Path
from typing import Any, cast

__all__ = [
    "ProcessDiedError",
    "adopt_orphans",
    "call_in_child",
    "die_with_parent",
    "kill_children",
]

_FORK = multiprocessing.get_context("fork")
_LIBC = ctypes.CDLL(None)  # loaded before a fork: in the child it would cost pages of memory
_PR_SET_PDEATHSIG, _PR_SET_CHILD_SUBREAPER = 1, 36  # of prctl(2)


class ProcessDiedError(Exception):
    """A process that ended without a result.

    Parameters
    ----------
    exit_code : int or None
        Its exit code; minus the signal's number if a signal ended it; None if it runs on.
    """

    def __init__(self, exit_code: int | None) -> None:
        super().__init__(exit_code)
        self.exit_code = exit_code


def call_in_child(function: Callable[..., Any], *arguments: Any, timeout: float) -> Any:
    """Return ``function(*arguments)``, computed in a fork of this process, which has one thread.

    The process ends as soon as its result is here.

    Parameters
    ----------
    function : callable
        Raises nothing, and returns what can be pickled.
    *arguments
        What it is called with.
    timeout : float
        Seconds after which the process is killed.

    Raises
    ------
    TimeoutError
        If the call took longer.
    ProcessDiedError
        If the process ended without a result.
    SystemExit
        If the process that started this one has ended: then nobody waits for the result.
    """
    receiver, sender = _FORK.Pipe(duplex=False)
    process = _FORK.Process(target=_report, args=(sender, function, arguments))
    process.start()
    sender.close()
    try:
        return pickle.loads(_received(receiver, process, timeout))
    finally:
        process.kill()
        process.join()
        process.close()


def _report(sender: Connection, function: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    die_with_parent()
    result = pickle.dumps(function(*arguments), protocol=pickle.HIGHEST_PROTOCOL)
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    sender.send_bytes(result)
    os._exit(0)  # at once: nothing here is worth tidying up


def _received(receiver: Connection, process: ForkProcess, timeout: float) -> bytes:
    # Not the process's sentinel, a pipe which stays open while a process that it started runs on.
    # And besides it the run: a worker's parent is the server that forks workers, which lives as
    # long as they do, so that `die_with_parent` comes too late.
    run = multiprocessing.parent_process()
    watched = [run.sentinel] if run else []
    ended = os.pidfd_open(cast(int, process.pid))
    try:
        with receiver:
            ready = wait([receiver, ended, *watched], timeout)
            if not ready:
                raise TimeoutError
            if set(watched) & set(ready):
                raise SystemExit
            if receiver.poll():
                return receiver.recv_bytes()
    except EOFError:  # it closed the pipe, and should end now
        wait([ended], timeout)
    finally:
        os.close(ended)
    raise ProcessDiedError(process.exitcode)


def adopt_orphans() -> None:
    """Become the parent of what descendants of this process leave behind, so that it is found."""
    _LIBC.prctl(_PR_SET_CHILD_SUBREAPER, 1)


def kill_children() -> None:
    """Kill every child of this process, and those that it then adopts."""
    while children := [*_children()]:
        for child in children:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)


def _children() -> Iterator[int]:
    for thread in Path("/proc/self/task").iterdir():
        with suppress(FileNotFoundError):  # a kernel that does not list children
            yield from map(int, (thread / "children").read_text().split())


def die_with_parent() -> None:
    """Have the system kill this process when the one that started it ends, however that ends."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
