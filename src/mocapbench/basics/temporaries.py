"""Temporary files and folders, which outlive their maker to the next start of another at most.

All have one kind of name, and their maker holds a lock, as the processes forked from it do. However
a process ends, the system lets go of its locks. So what nobody holds was left behind; `sweep`
deletes it, once files that count are in their places.
"""

from __future__ import annotations

import errno
import os
import secrets
import shutil
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from pathlib import Path

from mocapbench.basics.system.choice import find_system
from mocapbench.basics.transactions import finish

__all__ = [
    "PREFIX",
    "final_place",
    "sweep",
    "temporary_file",
    "temporary_folder",
]

PREFIX = ".mocapbench-tmp-"
"""How the names of all temporary files and folders begin."""
_IGNORE = ".gitignore"
"""The file of a folder that says ``*``, so that git takes nothing that was left there."""
_BUSY = "another process is writing it; wait for its end, or delete {} if there is none"


@contextmanager
def temporary_file(parent: Path) -> Iterator[Path]:
    """Make an empty file in a folder, which goes with the context unless it has moved.

    Who may read it is as the user's umask says, which `tempfile` does not ask.
    """
    with ExitStack() as held:
        path = _make(parent, "", partial(Path.touch, exist_ok=False), held)
        try:
            yield path
        finally:
            path.unlink(missing_ok=True)


@contextmanager
def temporary_folder(parent: Path, name: str = "") -> Iterator[Path]:
    """Make a folder in another one, which goes with the context.

    Parameters
    ----------
    parent : Path
    name : str, optional
        How its name ends; by default as no other does.

    Raises
    ------
    BlockingIOError
        If there is one of that name.
    """
    with ExitStack() as held:
        folder = _make(parent, name, partial(Path.mkdir, mode=0o700), held)
        (folder / _IGNORE).write_text("*\n")
        try:
            yield folder
        finally:
            _delete(folder)


def sweep(parent: Path) -> None:
    """Delete what processes of this user left behind in a folder."""
    for path in sorted(parent.glob(f"{PREFIX}*")):
        with suppress(OSError):  # in use, gone just now, another's, or on a system without locks
            if path.lstat().st_uid == _find_user():
                with find_system().hold_orphan(path):
                    _delete(path)


def final_place(path: Path) -> Path:
    """Return where a file in a temporary folder belongs; the path itself of any other."""
    for above in path.parents:
        if above.name.startswith(PREFIX):
            return final_place(above.with_name(path.name))
    return path


def _make(parent: Path, name: str, make: Callable[[Path], None], held: ExitStack) -> Path:
    """Make a file or folder, hold it, and return its path."""
    while True:
        path = parent / f"{PREFIX}{name or secrets.token_hex(4)}"
        try:
            make(path)
        except FileExistsError as error:
            raise BlockingIOError(errno.EBUSY, _BUSY.format(path), str(parent / name)) from error
        try:
            held.enter_context(find_system().hold(path))
        except (BlockingIOError, FileNotFoundError):  # somebody took it for left behind before
            continue
        except OSError:  # a file system without locks, on which nothing is swept
            pass
        return path


def _find_user() -> int:
    """Return whose files are ours; Windows says that all are those of user 0."""
    return os.geteuid() if hasattr(os, "geteuid") else 0


def _delete(path: Path) -> None:
    """Delete a file or folder, once files of it that count are in their places."""
    if path.is_dir():
        finish(path)
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)
