"""A call in a new interpreter, which takes seconds: it imports what the call needs.

The call and its result are files, since not every system hands open files down. Standard input is a
pipe, whose end says that the caller has ended.
"""

from __future__ import annotations

import pickle
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from multiprocessing.process import current_process
from multiprocessing.spawn import get_preparation_data
from pathlib import Path
from typing import Any

import psutil

from mocapbench.basics.system.base import ProcessDiedError
from mocapbench.basics.system.spawned_child import CALL, RESULT, STARTED
from mocapbench.basics.system.watch import kill_processes

__all__ = ["call_in_spawn"]

_LOOK = 0.05
"""Seconds between two looks at the child."""
_CHILD = "mocapbench.basics.system.spawned_child"


def call_in_spawn(
    prepare: Callable[[], object],
    function: Callable[..., Any],
    arguments: Sequence[Any],
    timeout: float,
    memory: float,
) -> bytes:
    """Return the pickled result of a call, made in a process that imports what it needs.

    Parameters
    ----------
    prepare, function, arguments
        See `mocapbench.basics.child.call_in_child`.
    timeout : float
        Seconds after which the process is killed, counted from when it is ready.
    memory : float
        Bytes that the process may hold.
    """
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as name:
        folder = Path(name)
        (folder / CALL).write_bytes(_pickle_call(prepare, (function, arguments, timeout, memory)))
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
        # -P, or Python would import from the current folder, where a file of somebody else may be.
        words = (sys.executable, "-P", "-m", _CHILD, name)
        with subprocess.Popen(words, stdin=subprocess.PIPE) as child:
            _Waiting(child, folder).wait(timeout, memory)
        if child.returncode or not (folder / RESULT).exists():
            raise ProcessDiedError(child.returncode)
        return (folder / RESULT).read_bytes()


def _pickle_call(prepare: Callable[[], object], call: tuple[Any, ...]) -> bytes:
    """Return what the child reads, in three parts: after each it knows how to read the next."""
    surroundings = get_preparation_data(current_process().name)
    del surroundings["authkey"]  # of `multiprocessing`, which does not let it be written down
    parts = surroundings, prepare, call
    return pickle.dumps([pickle.dumps(part, pickle.HIGHEST_PROTOCOL) for part in parts])


class _Waiting:
    """The wait for a child, of which nothing is left thereafter.

    Parameters
    ----------
    child : Popen
    folder : Path
        Where it says that it is ready.
    """

    def __init__(self, child: subprocess.Popen[bytes], folder: Path) -> None:
        self._child, self._started = child, folder / STARTED
        self._process = psutil.Process(child.pid)
        self._seen = {self._process}

    def wait(self, timeout: float, memory: float) -> None:
        """Wait for the child's end.

        Raises
        ------
        TimeoutError, MemoryError
            If it takes more time or memory: then it is killed.
        """
        end = float("inf")
        try:
            while not self._has_ended():
                self._require_memory(memory)
                if end == float("inf") and self._started.exists():
                    end = time.monotonic() + timeout
                if time.monotonic() > end:
                    raise TimeoutError
        finally:
            kill_processes([*self._seen])

    def _has_ended(self) -> bool:
        try:
            self._child.wait(_LOOK)
        except subprocess.TimeoutExpired:
            return False
        return True

    def _require_memory(self, most: float) -> None:
        """Take note of what the child has started, and refuse to let it hold too much memory."""
        try:
            self._seen.update(self._process.children(recursive=True))
            held = self._process.memory_info().rss
        except psutil.Error:  # it has ended just now
            return
        if held > 1.1 * most:  # it watches itself, and can say more of it
            raise MemoryError(f"it held {held / 2**30:.1f} GiB")
