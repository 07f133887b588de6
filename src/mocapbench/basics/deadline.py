"""When this process is to end."""

from __future__ import annotations

import math
import os
import time

__all__ = ["count_seconds_left", "set_deadline"]

_DEADLINE = "MOCAPBENCH_DEADLINE"
"""The variable of the environment with the end of the time that this process has been given."""


def set_deadline(seconds: float) -> None:
    """Have this process know that it is killed in so many seconds."""
    os.environ[_DEADLINE] = repr(time.monotonic() + seconds)


def count_seconds_left() -> float:
    """Return in how many seconds this process is killed; infinity if that is not known."""
    return float(os.environ.get(_DEADLINE, math.inf)) - time.monotonic()
