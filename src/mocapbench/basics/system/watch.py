"""A thread that watches this process where the system does not: its limits, and its parent.

It looks some twenty times a second, and as soon as a library lets other threads run: what a library
does in one call is noticed after that call.
"""

from __future__ import annotations

import ctypes
import math
import os
import threading
import time
from collections.abc import Callable
from contextlib import suppress

import psutil

__all__ = [
    "END_OF_MEMORY",
    "END_OF_TIME",
    "END_OF_WORK",
    "Watch",
    "end_at_once",
    "end_with",
    "kill_descendants",
    "kill_processes",
]

END_OF_TIME, END_OF_MEMORY, END_OF_WORK = 124, 137, 152
"""Exit codes of processes that have exceeded a limit; those that shells give in such cases."""
_LOOK, _PATIENCE = 0.05, 2.0
"""Seconds between two looks; and for which this process may work on with too much memory, or others
may take to end.
"""


class Watch:
    """What is watched of this process, from its first limit on.

    Attributes
    ----------
    memory : float
        Bytes that it may hold.
    work : float
        Seconds of a processor that it may take.
    end : float
        When it is to end, by `time.monotonic`.
    peak : int
        The most bytes that were seen.
    """

    def __init__(self) -> None:
        self.memory: float = math.inf
        self.work: float = math.inf
        self.end: float = math.inf
        self.peak: int = 0
        self._excess = math.inf
        self._process = psutil.Process()
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Watch from now on, unless that is so already."""
        if self._thread is None:
            self.look()
            self._thread = threading.Thread(target=self._look_on, daemon=True)
            self._thread.start()

    def look(self) -> int:
        """Return how many bytes this process holds, and take note of it."""
        held: int = self._process.memory_info().rss
        self.peak = max(self.peak, held)
        return held

    def _look_on(self) -> None:
        while True:
            time.sleep(_LOOK)
            self._require_memory(self.look())
            if time.process_time() > self.work:
                end_at_once(END_OF_WORK)
            if time.monotonic() > self.end:
                end_at_once(END_OF_TIME)

    def _require_memory(self, held: int) -> None:
        """Raise an error in the main thread, and end the process if that is of no use."""
        worked = time.process_time()
        if held <= self.memory:
            self._excess = math.inf
        elif self._excess == math.inf:
            self._excess = worked
            main = ctypes.c_ulong(threading.main_thread().ident or 0)
            ctypes.pythonapi.PyThreadState_SetAsyncExc(main, ctypes.py_object(MemoryError))
        elif worked > self._excess + _PATIENCE:
            end_at_once(END_OF_MEMORY)


def end_with(wait: Callable[[], object]) -> None:
    """End this process once a function returns, which waits for the end of another."""

    def wait_and_end() -> None:
        wait()
        end_at_once(1)

    threading.Thread(target=wait_and_end, daemon=True).start()


def end_at_once(exit_code: int) -> None:
    """End this process, whatever it does, with what it has started.

    Those are not waited for: meanwhile the main thread could report their ends as if it went on.
    """
    _kill(_list_descendants(psutil.Process()))
    os._exit(exit_code)


def kill_descendants(process: psutil.Process) -> None:
    """Kill what a process has started, and what these have, as far as that shows."""
    kill_processes(_list_descendants(process))


def kill_processes(processes: list[psutil.Process]) -> None:
    """Kill processes, and wait for their ends."""
    _kill(processes)
    psutil.wait_procs(processes, timeout=_PATIENCE)


def _list_descendants(process: psutil.Process) -> list[psutil.Process]:
    try:
        return process.children(recursive=True)
    except psutil.Error:  # it has ended
        return []


def _kill(processes: list[psutil.Process]) -> None:
    for process in processes:
        with suppress(psutil.Error):  # it has ended, or is another's
            process.kill()
