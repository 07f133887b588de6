"""Interrupts that wait: none strikes where it would leave a lock taken for ever."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["interrupts_later"]

_ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


@contextmanager
def interrupts_later() -> Iterator[None]:
    """Have Ctrl-C, and other signals that end processes, strike at the end of the context.

    Python runs handlers between any two steps of the main thread. One that raises between the
    taking of a lock and the block that gives it back leaves the lock taken, and whoever waits for
    it waits for ever. Signals without a handler of Python's, and other threads, are as before.
    """
    caught: list[int] = []
    before = {}
    try:
        if threading.current_thread() is threading.main_thread():
            for number in _ENDING:
                if callable(signal.getsignal(number)):
                    before[number] = signal.signal(number, lambda each, _: caught.append(each))
        yield
    finally:
        for number in reversed(before):  # the first was held back first, and is so to the last
            signal.signal(number, before[number])
        for struck in caught[:1]:
            signal.raise_signal(struck)
