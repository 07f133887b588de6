"""A call in a process of its own: its crash, hang or kill costs this call alone.

What the call changes in its process ends with it, and its peak memory is its own.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable
from typing import Any

from mocapbench.basics.system.base import ProcessDiedError
from mocapbench.basics.system.choice import find_system

__all__ = ["LONGEST", "ProcessDiedError", "call_in_child"]

LONGEST = 2e6
"""Seconds that the system can be asked to wait at once, which are 23 days."""


def _prepare_nothing() -> None:
    """Do nothing: the call needs nothing but what it imports."""


def call_in_child(
    function: Callable[..., Any],
    *arguments: Any,
    timeout: float,
    prepare: Callable[[], object] = _prepare_nothing,
) -> Any:
    """Return ``function(*arguments)``, computed in a child of this process, which has one thread.

    The process ends as soon as its result is here.

    Parameters
    ----------
    function : callable
        Raises nothing. It can be pickled, and so can what it returns.
    *arguments
        What it is called with; they can be pickled.
    timeout : float
        Seconds after which the process is killed; what is longer counts as `LONGEST`.
    prepare : callable, optional
        Is called first, with nothing: registers what ``function`` looks up. To call it again where
        it has been called changes nothing.

    Raises
    ------
    TimeoutError
        If the call took longer, or the process lives on without a way to report.
    MemoryError
        If the process holds more memory than this one may.
    ProcessDiedError
        If the process ended without a result.
    SystemExit
        If the process that started this one has ended: then nobody waits for the result.
    """
    seconds = min(timeout, LONGEST)
    return pickle.loads(find_system().call(prepare, function, arguments, seconds))
