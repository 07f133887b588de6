"""The time that a job may take, in its worker and in its model's process together."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any

from mocapbench.basics.child import LONGEST, call_in_child
from mocapbench.basics.system.choice import find_system

__all__ = ["TimeLimit"]

_SHORTEST = 1e-3  # s; a timer of none never ends


class TimeLimit(AbstractContextManager["TimeLimit"]):
    """A context in which this process is ended when the time is up.

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
        find_system().stop_timer()

    def call_in_child(self, function: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
        """Return ``function(*arguments)``, for which a child of this process has the time left.

        Parameters
        ----------
        function, *arguments
            As for `mocapbench.basics.child.call_in_child`.
        **options
            Others of its than the time.

        Raises
        ------
        TimeoutError
            If it took longer: then the child is killed, and this process is not.
        ProcessDiedError, SystemExit
            As `mocapbench.basics.child.call_in_child` does.
        """
        self.__exit__()
        result = call_in_child(function, *arguments, timeout=self._left, **options)
        self._start_timer()
        return result

    @property
    def _left(self) -> float:
        return max(self._end - time.monotonic(), _SHORTEST)

    def _start_timer(self) -> None:
        find_system().start_timer(self._left)
