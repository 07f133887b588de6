"""The time that a job may take, in its worker and in its model's process together."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any

from mocapbench.benchmark.runs.execution.child import LONGEST, call_in_child

__all__ = ["TimeLimit"]

_SHORTEST = 1e-3  # s; a timer of none never ends


class TimeLimit(AbstractContextManager["TimeLimit"]):
    """A context in which this process is killed by SIGALRM when the time is up.

    A signal that is not handled ends a loop in a library's C code, too.

    Parameters
    ----------
    seconds : float
        What is longer than the system can wait, infinity included, counts as 23 days.
    """

    def __init__(self, seconds: float) -> None:
        self._seconds = min(seconds, LONGEST)
        self._end = 0.0

    def __enter__(self) -> TimeLimit:
        """Start the timer."""
        self._end = time.monotonic() + self._seconds
        self._start_timer()
        return self

    def __exit__(self, *_: object) -> None:
        """Stop the timer."""
        signal.setitimer(signal.ITIMER_REAL, 0.0)

    def call_in_child(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Return ``function(*arguments)``, for which a child of this process has the time left.

        Raises
        ------
        TimeoutError
            If it took longer: then the child is killed, and this process is not.
        ProcessDiedError, SystemExit
            As `mocapbench.benchmark.runs.execution.child.call_in_child` does.
        """
        self.__exit__()
        result = call_in_child(function, *arguments, timeout=self._left)
        self._start_timer()
        return result

    @property
    def _left(self) -> float:
        return max(self._end - time.monotonic(), _SHORTEST)

    def _start_timer(self) -> None:
        signal.setitimer(signal.ITIMER_REAL, self._left)
