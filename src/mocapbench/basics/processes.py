"""A process: when it is to end, what it has started, and the memory that these take together."""

from __future__ import annotations

import ctypes
import math
import os
import signal
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import psutil

__all__ = [
    "adopt_orphans",
    "count_seconds_left",
    "die_with_parent",
    "kill_children",
    "list_children",
    "measure_memory",
    "set_deadline",
]

_LIBC = ctypes.CDLL(None)  # loaded before a fork: in the child it would cost pages of memory
_PR_SET_PDEATHSIG, _PR_SET_CHILD_SUBREAPER = 1, 36  # of prctl(2)
_DEADLINE = "MOCAPBENCH_DEADLINE"
"""The variable of the environment with the end of the time that this process has been given."""


def die_with_parent() -> None:
    """Have the system kill this process when the one that started it ends, however that ends."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def adopt_orphans() -> None:
    """Become the parent of what descendants of this process leave behind, so that it is found."""
    _LIBC.prctl(_PR_SET_CHILD_SUBREAPER, 1)


def kill_children() -> None:
    """Kill every child of this process, and those that it then adopts."""
    while children := [*list_children()]:
        for child in children:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)


def set_deadline(seconds: float) -> None:
    """Have this process know that it is killed in so many seconds."""
    os.environ[_DEADLINE] = repr(time.monotonic() + seconds)


def count_seconds_left() -> float:
    """Return in how many seconds this process is killed; infinity if that is not known."""
    return float(os.environ.get(_DEADLINE, math.inf)) - time.monotonic()


def list_children(process: int | str = "self") -> Iterator[int]:
    """Yield the numbers of the processes that a process has started."""
    for thread in Path(f"/proc/{process}/task").iterdir():
        with suppress(FileNotFoundError):  # a kernel that does not list children
            yield from map(int, (thread / "children").read_text().split())


def measure_memory(process: int) -> int:
    """Return the bytes of memory that a process and all that it has started hold."""
    held = 0
    with suppress(psutil.Error, OSError):  # it has ended meanwhile
        held += psutil.Process(process).memory_info().rss
        held += sum(map(measure_memory, list_children(process)))
    return held
