"""A call in a process of its own: its crash, hang or kill costs this call alone.

The process is forked from one that has loaded what the call needs, which takes milliseconds. What
the call changes in its process ends with it, and its peak memory is its own.
"""

from __future__ import annotations

import multiprocessing
import os
import pickle
import signal
import sys
import traceback
from collections.abc import Callable
from multiprocessing.connection import Connection, wait
from typing import Any, NoReturn

from mocapbench.basics.processes import die_with_parent, set_deadline

__all__ = ["LONGEST", "ProcessDiedError", "call_in_child"]

LONGEST = 2e6
"""Seconds that the system can be asked to wait at once, which are 23 days."""


class ProcessDiedError(Exception):
    """A process that ended without a result.

    Parameters
    ----------
    exit_code : int
        Its exit code; minus the signal's number if a signal ended it.
    """

    def __init__(self, exit_code: int) -> None:
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
        Seconds after which the process is killed; what is longer counts as `LONGEST`.

    Raises
    ------
    TimeoutError
        If the call took longer, or the process lives on without a way to report.
    ProcessDiedError
        If the process ended without a result.
    SystemExit
        If the process that started this one has ended: then nobody waits for the result.
    """
    receiver, sender = multiprocessing.Pipe(duplex=False)
    _flush()  # or the child would print again what waits to be printed
    # Not by `multiprocessing.Process`, which changes memory that would have to be copied.
    child = os.fork()
    if not child:
        _report(sender, function, arguments, timeout)
    sender.close()
    try:
        result = _receive_report(receiver, child, min(timeout, LONGEST))
    finally:
        os.kill(child, signal.SIGKILL)
        _, status = os.waitpid(child, 0)
    if not result:
        raise ProcessDiedError(os.waitstatus_to_exitcode(status))
    return pickle.loads(result)


def _flush() -> None:
    for stream in (sys.stdout, sys.stderr):
        stream.flush()


def _report(
    sender: Connection, function: Callable[..., Any], arguments: tuple[Any, ...], timeout: float
) -> NoReturn:
    exit_code = 1
    try:
        die_with_parent()
        set_deadline(timeout)
        result = pickle.dumps(function(*arguments), protocol=pickle.HIGHEST_PROTOCOL)
        _flush()
        sender.send_bytes(result)
        exit_code = 0
    except BaseException:
        traceback.print_exc()
    finally:  # at once: nothing is worth tidying up, and what the caller does next is not for it
        os._exit(exit_code)


def _receive_report(receiver: Connection, child: int, timeout: float) -> bytes:
    """Return what the child reports; nothing if it ends, or has ended, without a report."""
    # Besides the child the run is watched: a worker's parent is the server that forks workers,
    # which lives as long as they do, so that `die_with_parent` comes too late.
    run = multiprocessing.parent_process()
    watched = [run.sentinel] if run else []
    ended = os.pidfd_open(child)
    try:
        with receiver:
            ready = wait([receiver, ended, *watched], timeout)
            if set(watched) & set(ready):
                raise SystemExit
            if receiver in ready or receiver.poll():
                return receiver.recv_bytes()
    except EOFError:  # it closed the pipe, and should end now
        ready = wait([ended], timeout)
    finally:
        os.close(ended)
    if not ready:
        raise TimeoutError
    return b""
