"""Folders of temporary files; one that a killed process left goes when the next one is made."""

from __future__ import annotations

import fcntl
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

__all__ = ["scratch_folder"]

_PREFIX = "mocapbench-scratch-"


@contextmanager
def scratch_folder() -> Iterator[Path]:
    """Make a folder of temporary files, which goes with the context.

    Its maker and the processes forked from it hold its lock. Folders of which nobody holds the
    lock are deleted: their makers were killed.
    """
    for left_behind in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        _delete_unless_locked(left_behind)
    folder, lock = _locked_folder()
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        os.close(lock)


def _locked_folder() -> tuple[Path, int]:
    """Return a new folder and the descriptor that holds its lock."""
    while True:
        folder = Path(tempfile.mkdtemp(prefix=_PREFIX))
        with suppress(FileNotFoundError):  # others may take it for left behind until it is locked
            lock = _open_folder(folder)
            with suppress(OSError):  # a file system without locks, where nothing is deleted either
                fcntl.flock(lock, fcntl.LOCK_EX)
            if folder.exists():
                return folder, lock
            os.close(lock)


def _delete_unless_locked(folder: Path) -> None:
    with suppress(OSError):  # deleted by others just now, or not ours
        lock = _open_folder(folder)
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            shutil.rmtree(folder, ignore_errors=True)
        finally:
            os.close(lock)


def _open_folder(folder: Path) -> int:
    return os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
