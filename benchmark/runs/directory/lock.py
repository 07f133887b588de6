"""The lock of a run directory: one run writes at a time, and others can see that it does."""

from __future__ import annotations

import fcntl
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from filelock import FileLock, Timeout

from mocapbench.benchmark.errors import UsageError

__all__ = ["held", "is_held"]

_LOCK = "mocapbench.lock"
_PATIENCE = 0.2
"""Seconds; whoever only looks whether the lock is held has it for a moment."""


@contextmanager
def held(folder: Path) -> Iterator[None]:
    """Keep other runs out of ``folder``.

    Raises
    ------
    UsageError
        If another run is in it.
    """
    lock = FileLock(folder / _LOCK, timeout=_PATIENCE)
    try:
        lock.acquire()
    except Timeout as error:
        raise UsageError(
            f"--out: another run is writing to {folder}; wait for it or name another folder "
            "(`mocapbench merge` unites the two later)"
        ) from error
    try:
        yield
    finally:
        lock.release()


def is_held(folder: Path) -> bool:
    """Return whether a run is writing to ``folder``, which need not be writable."""
    try:
        with (folder / _LOCK).open("rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except FileNotFoundError:
        return False
    except BlockingIOError:
        return True
    return False
