"""When this process is to end."""

from __future__ import annotations

import math
import os
import time

__all__ = ["DEADLINE", "count_seconds_left", "find_deadline", "set_deadline"]

DEADLINE = "MOCAPBENCH_DEADLINE"
"""The variable of the environment that says when a process is killed, by the monotonic clock."""


def set_deadline(seconds: float) -> None:
    """Have this process know that it is killed in so many seconds."""
    os.environ[DEADLINE] = find_deadline(seconds)


def find_deadline(seconds: float) -> str:
    """Return what the environment of a process says that ends in so many seconds."""
    return repr(time.monotonic() + seconds)


def count_seconds_left() -> float:
    """Return in how many seconds this process is killed; infinity if that is not known."""
    return float(os.environ.get(DEADLINE, math.inf)) - time.monotonic()
