"""Signals that end processes: a command winds up first, and its exit code names the signal."""

from __future__ import annotations

import _thread
import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from mocapbench.basics.system.starting import list_signals, strike_main_thread
from mocapbench.benchmark.errors import Interruption

__all__ = ["wind_up_at_signals"]

_ENDING = list_signals("SIGINT", "SIGTERM", "SIGHUP")
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
        self._has_struck, self._is_over = False, False
        self._waiting: list[int] = []

    def receive(self, number: int, frame: FrameType | None) -> None:
        """Interrupt what runs, or once an import is over; the second signal does not wait."""
        if self._is_over:
            return
        if self.interruption is None:
            self.interruption = Interruption(number)
            if _is_importing(frame):
                self._waiting.append(number)
                # Not by `threading`, whose locks may be held by what the signal has met.
                _thread.start_new_thread(self._strike_later, ())
                return
        self._has_struck = True
        raise self.interruption

    def _strike_later(self) -> None:
        main, latest = threading.main_thread().ident or 0, time.monotonic() + _PATIENCE
        while (
            not self._has_struck
            and _is_importing(sys._current_frames().get(main))
            and time.monotonic() < latest
        ):
            time.sleep(_PAUSE)
        if not self._has_struck:
            strike_main_thread(self._waiting[0])
        self._waiting.pop()

    def finish(self) -> None:
        """Return once no signal waits; those that come meanwhile change nothing."""
        self._is_over = self._has_struck = self.interruption is not None
        while self._waiting:
            time.sleep(_PAUSE)


@contextmanager
def _handlers(ending: _Ending) -> Iterator[None]:
    """Handle signals within the context, but those that are ignored, as SIGHUP under nohup."""
    before: dict[int, Any] = {}
    if threading.current_thread() is threading.main_thread():
        before = {number: signal.getsignal(number) for number in _ENDING}
    heard = [number for number in before if before[number] is not signal.SIG_IGN]
    try:
        for number in heard:
            signal.signal(number, ending.receive)
        yield
    finally:
        ending.finish()
        for number in heard:
            signal.signal(number, before[number])


def _is_importing(frame: FrameType | None) -> bool:
    while frame is not None:
        code = frame.f_code
        if code.co_name == "_find_and_load" and code.co_filename.startswith("<frozen importlib."):
            return True
        frame = frame.f_back
    return False
