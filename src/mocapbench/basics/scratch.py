"""Folders of temporary files where the system keeps such files."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import cache
from multiprocessing.util import Finalize
from pathlib import Path

from mocapbench.basics.temporaries import sweep, temporary_folder

__all__ = ["process_folder", "scratch_folder", "sweep_scratch"]

_LAST = -200
"""Of what is done when a process ends: after `multiprocessing` has deleted its own files."""


@contextmanager
def scratch_folder() -> Iterator[Path]:
    """Make a folder of temporary files, which goes with the context; those left behind go now."""
    sweep_scratch()
    with temporary_folder(Path(tempfile.gettempdir())) as folder:
        yield folder


def sweep_scratch() -> None:
    """Delete scratch folders that killed processes left behind."""
    sweep(Path(tempfile.gettempdir()))


def process_folder() -> Path:
    """Return a scratch folder of this process, which goes when the process ends."""
    return _folder_of(os.getpid())


@cache
def _folder_of(_pid: int) -> Path:
    """Return the folder of this process, and not of the one from which it was forked."""
    held = ExitStack()
    folder = held.enter_context(scratch_folder())
    Finalize(None, held.close, exitpriority=_LAST)
    return folder
