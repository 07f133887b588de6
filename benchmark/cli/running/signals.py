"""Signals that end processes: a run winds up first, as it does at Ctrl-C."""

from __future__ import annotations

import signal
from types import FrameType

__all__ = ["interrupt_at_the_end_of_the_session"]


def interrupt_at_the_end_of_the_session() -> None:
    """Have the signals that end processes interrupt the run, which then winds up."""
    for ending in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(ending) is not signal.SIG_IGN:  # as under nohup
            signal.signal(ending, _interrupt)


def _interrupt(_signal: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt
