"""Signals that end processes: a command winds up first, and its exit code names the signal."""

from __future__ import annotations

import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from mocapbench.basics.system.choice import find_system
from mocapbench.basics.system.starting import list_signals
from mocapbench.benchmark.errors import Interruption

__all__ = ["wind_up_at_signals"]

_ENDING, _ALARM = list_signals("SIGINT", "SIGTERM", "SIGHUP"), list_signals("SIGALRM")
_PATIENCE = 5.0
"""Seconds for which a signal waits for the end of an import at most."""
_PAUSE = 0.02
"""Seconds after which it looks whether the import has ended."""


@contextmanager
def wind_up_at_signals() -> Iterator[None]:
    """Have Ctrl-C, and other signals that end processes, raise `KeyboardInterrupt`.

    Whatever becomes of it, the process ends with the code of the signal.

    Raises
    ------
    SystemExit
        At the end of the context, if a signal has struck within.
    """
    ending = _Ending()
    with _handlers(ending):
        try:
            yield
        finally:
            if ending.interruption is not None:
                sys.exit(ending.interruption.exit_code)


class _Ending:
    """The end of a process, by the first signal that strikes.

    Within an import it strikes after it: the interpreter ignores what is raised where it releases
    the lock of a module, and so do libraries that try whether they can import another.
    """

    def __init__(self) -> None:
        self.interruption: Interruption | None = None
        self._latest = 0.0

    def receive(self, number: int, frame: FrameType | None) -> None:
        """Take note of a signal; the second does not wait."""
        if self.interruption is None:
            self._latest = time.monotonic() + _PATIENCE
            self.interruption = Interruption(number)
        else:
            self._latest = 0.0
        self.strike(number, frame)

    def strike(self, _number: int, frame: FrameType | None) -> None:
        """Interrupt what runs, or come back a little later."""
        waits = _is_importing(frame) and time.monotonic() < self._latest
        if waits and find_system().send_alarm(_PAUSE):
            return
        if self.interruption is not None:
            raise self.interruption


@contextmanager
def _handlers(ending: _Ending) -> Iterator[None]:
    """Handle signals within the context, but those that are ignored, as SIGHUP under nohup."""
    before: dict[int, Any] = {}
    if threading.current_thread() is threading.main_thread():
        before = {number: signal.getsignal(number) for number in (*_ENDING, *_ALARM)}
    heard = [number for number in before if before[number] is not signal.SIG_IGN]
    try:
        for number in heard:
            signal.signal(number, ending.strike if number in _ALARM else ending.receive)
        yield
    finally:
        if ending.interruption is not None:
            find_system().stop_timer()
        for number in heard:
            signal.signal(number, before[number])


def _is_importing(frame: FrameType | None) -> bool:
    while frame is not None:
        code = frame.f_code
        if code.co_name == "_find_and_load" and code.co_filename.startswith("<frozen importlib."):
            return True
        frame = frame.f_back
    return False
