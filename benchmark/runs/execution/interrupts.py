"""Interrupts that wait: none strikes where it would leave a lock taken for ever."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from mocapbench.basics.system.starting import list_signals

__all__ = ["interrupts_later"]

_ENDING = list_signals("SIGINT", "SIGTERM", "SIGHUP")


@contextmanager
def interrupts_later() -> Iterator[None]:
    """Have Ctrl-C, and other signals that end processes, strike at the end of the context.

    Python runs handlers between any two steps of the main thread. One that raises between the
    taking of a lock and the block that gives it back leaves the lock taken, and whoever waits for
    it waits for ever. Of several signals, which all end the process, the first strikes. Signals
    without a handler of Python's, and other threads, are as before.
    """
    caught: list[int] = []
    before: dict[int, Callable[[int, FrameType | None], Any]] = {}
    held = True

    def delay(number: int, frame: FrameType | None) -> None:
        if held:
            caught.append(number)
        else:  # another signal struck before this handler was put back
            before[number](number, frame)

    try:
        if threading.current_thread() is threading.main_thread():
            before |= {n: old for n in _ENDING if callable(old := signal.getsignal(n))}
            for number in before:
                signal.signal(number, delay)
        yield
    finally:
        held = False
        for number, handler in before.items():
            signal.signal(number, handler)
        for number in caught[:1]:
            signal.raise_signal(number)
