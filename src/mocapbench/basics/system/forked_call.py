"""A call in a fork of this process, which takes milliseconds."""

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

from mocapbench.basics.deadline import set_deadline
from mocapbench.basics.system.base import ProcessDiedError

__all__ = ["call_in_fork"]


def call_in_fork(call: Callable[[], Any], begin: Callable[[], None], timeout: float) -> bytes:
    """Return the pickled result of a call, made in a fork of this process, which has one thread.

    Parameters
    ----------
    call : callable
        Raises nothing, and returns what can be pickled.
    begin : callable
        What the fork does first.
    timeout : float
        Seconds after which the fork is killed.
    """
    receiver, sender = multiprocessing.Pipe(duplex=False)
    _flush()  # or the child would print again what waits to be printed
    # Not by `multiprocessing.Process`, which changes memory that would have to be copied.
    child = os.fork()
    if not child:
        _report(sender, call, begin, timeout)
    sender.close()
    try:
        result = _receive_report(receiver, child, timeout)
    finally:
        os.kill(child, signal.SIGKILL)
        _, status = os.waitpid(child, 0)
    if not result:
        raise ProcessDiedError(os.waitstatus_to_exitcode(status))
    return result


def _flush() -> None:
    for stream in (sys.stdout, sys.stderr):
        stream.flush()


def _report(
    sender: Connection, call: Callable[[], Any], begin: Callable[[], None], timeout: float
) -> NoReturn:
    exit_code = 1
    try:
        begin()
        set_deadline(timeout)
        result = pickle.dumps(call(), protocol=pickle.HIGHEST_PROTOCOL)
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
    # which lives as long as they do, so that the death of the parent comes too late.
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
