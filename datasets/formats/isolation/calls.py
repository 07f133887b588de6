"""Calls in a process of their own, for libraries that a damaged file can crash.

The process is started when first needed and lives for many calls, as starting it takes longer than
reading most files. One that crashes, or is killed because it takes too long, costs that call alone:
the next one gets a new process.
"""

from __future__ import annotations

import atexit
import json
import os
import subprocess
import sys
import threading
from collections.abc import Mapping
from contextlib import ExitStack
from functools import cache
from io import BytesIO
from typing import IO, Any, cast

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.formats.isolation.process import LENGTH

__all__ = ["IsolatedCallError", "call_isolated"]

# -P, or Python would import from the current folder, where a file of somebody else may be called
# json.py.
_COMMAND = (sys.executable, "-P", "-m", "mocapbench.datasets.formats.isolation.process")

_KILLED = -9
"""The exit code of a process that Linux kills where memory is short."""


class IsolatedCallError(Exception):
    """A call that ended without a result; the message says why, to follow "got"."""


def call_isolated(
    function: str, *arguments: str, timeout: float, memory: float
) -> Mapping[str, NDArray[Any]]:
    """Return what a function returns in a process of its own.

    Parameters
    ----------
    function : str
        ``module:name`` of a function of strings that returns arrays by name.
    *arguments : str
        What it is called with.
    timeout : float
        Seconds after which the process is killed.
    memory : float
        Bytes that the call may take.

    Raises
    ------
    IsolatedCallError
        If the function raises, takes more time or memory, or crashes its process.
    """
    return _process_of(os.getpid()).call(function, arguments, timeout, memory)


class _Process:
    """A process that answers one call at a time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._owner = os.getpid()
        self._running: subprocess.Popen[bytes] | None = None

    def call(
        self, function: str, arguments: tuple[str, ...], timeout: float, memory: float
    ) -> Mapping[str, NDArray[Any]]:
        """Return what `call_isolated` returns."""
        request = json.dumps([function, arguments, int(memory)]).encode() + b"\n"
        with self._lock, ExitStack() as unless_answered:
            process = self._start_if_stopped()
            # Also if interrupted: the next call would take the answer to this one for its own.
            unless_answered.callback(self.close)
            stopped = threading.Event()
            timer = threading.Timer(timeout, _stop, (process, stopped))
            timer.start()
            try:
                answer = _answer(process, request)
            except EOFError:
                exit_code = process.wait()
                raise IsolatedCallError(
                    f"no end of reading it within {timeout:.0f} s, or too little memory"
                    if stopped.is_set() or exit_code == _KILLED
                    else f"a crash of the library that reads it (exit code {exit_code})"
                ) from None
            finally:
                timer.cancel()
            unless_answered.pop_all()
        return _result(answer)

    def close(self) -> None:
        """End the process, if it runs and is that of this process and not of the one forked."""
        running, self._running = self._running, None
        if running is not None and os.getpid() == self._owner:
            running.kill()
            running.communicate()  # closes the pipes and waits

    def _start_if_stopped(self) -> subprocess.Popen[bytes]:
        if self._running is None or self._running.poll() is not None:
            self._running = subprocess.Popen(
                _COMMAND,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
            )
        return self._running


def _answer(process: subprocess.Popen[bytes], request: bytes) -> bytes:
    """Return the answer to a request.

    Raises
    ------
    EOFError
        If the process ended before it gave one.
    """
    requests, answers = cast(IO[bytes], process.stdin), cast(IO[bytes], process.stdout)
    try:
        requests.write(request)
        requests.flush()
    except BrokenPipeError:
        raise EOFError from None
    length = int.from_bytes(_exactly(answers, LENGTH))
    return _exactly(answers, length)


def _exactly(stream: IO[bytes], n_bytes: int) -> bytes:
    data = stream.read(n_bytes)
    if len(data) < n_bytes:
        raise EOFError
    return data


def _result(answer: bytes) -> Mapping[str, NDArray[Any]]:
    # Not pickle, which would run what a process that was taken over by a hostile file answers.
    with np.load(BytesIO(answer), allow_pickle=False) as arrays:
        result = dict(arrays)
    if "error" in result:
        raise IsolatedCallError(str(result["error"]))
    return result


def _stop(process: subprocess.Popen[bytes], stopped: threading.Event) -> None:
    """Kill a process, and say so: not every system tells it by the exit code."""
    stopped.set()
    process.kill()


@cache
def _process_of(_pid: int) -> _Process:
    """Return the process that serves this one; a fork of this one gets another."""
    process = _Process()
    atexit.register(process.close)
    return process
