"""A call in a process of its own: its crash, hang or kill costs this call alone.

The process is forked from one that has loaded what the call needs, which takes milliseconds. What
the call changes in its process ends with it, and its peak memory is its own.
"""

from __future__ import annotations

import ctypes
import multiprocessing
import pickle
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkProcess
from typing import Any

import psutil

__all__ = ["ProcessDiedError", "call_in_child", "die_with_parent"]

_FORK = multiprocessing.get_context("fork")
_PR_SET_PDEATHSIG = 1  # of prctl(2)


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

    The process is killed as soon as its result is here.

    Parameters
    ----------
    function : callable
        Raises nothing, and returns what can be pickled.
    *arguments
        What it is called with.
    timeout : float
        Seconds after which the process and its descendants are killed.

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
    with receiver:
        try:
            return pickle.loads(_received(receiver, process, timeout))
        except EOFError:
            process.join(timeout)
            raise ProcessDiedError(process.exitcode) from None
        except (TimeoutError, SystemExit):
            _kill_descendants(process)
            raise
        finally:
            process.kill()
            process.join()
            process.close()


def _report(sender: Connection, function: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    die_with_parent()
    result = pickle.dumps(function(*arguments), protocol=pickle.HIGHEST_PROTOCOL)
    for stream in (sys.stdout, sys.stderr):
        stream.flush()  # the process is killed once its result has been read
    sender.send_bytes(result)


def _received(receiver: Connection, process: ForkProcess, timeout: float) -> bytes:
    # The process is waited for as well: one that it started may keep its end of the pipe open.
    # So is the parent, in vain by `die_with_parent`: that of a worker is the server that forks
    # workers, which lives as long as they do.
    parent = multiprocessing.parent_process()
    parents = [parent.sentinel] if parent else []
    ready = wait([receiver, process.sentinel, *parents], timeout)
    if not ready:
        raise TimeoutError
    if set(parents) & set(ready):
        raise SystemExit
    if not receiver.poll():
        raise EOFError
    return receiver.recv_bytes()


def _kill_descendants(process: ForkProcess) -> None:
    with suppress(psutil.NoSuchProcess):  # it may end at this very moment
        for descendant in psutil.Process(process.pid).children(recursive=True):
            descendant.kill()


def die_with_parent() -> None:
    """Have the system kill this process when the one that started it ends, however that ends."""
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
