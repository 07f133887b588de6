"""Files that are written whole or not at all."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from mocapbench.benchmark.errors import UsageError

__all__ = [
    "ENTRIES",
    "atomic_write",
    "is_writable",
    "require_writable_folder",
    "target_of",
    "words_of",
    "write_bytes",
    "write_text",
]

ENTRIES = ".entries.csv"
"""How the name of a table of filled entries ends, which `mocapbench fill` writes beside a file."""


_READABLE = 0o644
_SUFFIX = ".tmp"
_TEMPORARY = re.compile(r"\.(?P<target>.+)\.[a-z0-9_]{8}\.tmp")
"""The names that `atomic_write` gives."""


@contextmanager
def atomic_write(path: Path) -> Iterator[IO[bytes]]:
    """Open a temporary file beside ``path`` that takes its name only when all is written."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=_SUFFIX)
    try:
        with os.fdopen(handle, "wb") as file:
            yield file
        Path(temporary).chmod(_READABLE)  # temporary files are their owner's alone
        Path(temporary).replace(path)
    except OSError as error:
        Path(temporary).unlink(missing_ok=True)
        error.filename = error.filename or str(path)  # which errors of writing lack
        raise
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def write_text(path: Path, text: str) -> None:
    """Write ``text`` as UTF-8, whole or not at all."""
    write_bytes(path, text.encode())


def write_bytes(path: Path, content: bytes) -> None:
    """Write ``content`` whole or not at all."""
    with atomic_write(path) as file:
        file.write(content)


def is_writable(folder: Path) -> bool:
    """Return whether files can be made in ``folder``, or the folder itself where there is none."""
    present = next(path for path in (folder, *folder.absolute().parents) if path.exists())
    return present.is_dir() and os.access(present, os.W_OK | os.X_OK)


def require_writable_folder(option: str, folder: Path) -> None:
    """Refuse the folder that an option of the command line asks to write to.

    Raises
    ------
    UsageError
        If files cannot be made there.
    """
    if not is_writable(folder):
        raise UsageError(
            f"{option}: expected a folder that can be written to, got {folder}; "
            "name another, or change its permissions"
        )


def words_of(error: OSError) -> str:
    """Return what an error of the system says, without its number, and of which file."""
    said = error.strerror or str(error) or type(error).__name__
    if not isinstance(error.filename, str):
        return said
    path = Path(error.filename)
    target = target_of(path)  # people know the file by this name
    return f"{path.with_name(target) if target else path}: {said}"


def target_of(temporary: Path) -> str:
    """Return the name that `atomic_write` meant a file for; nothing if the file is not its own.

    Such a file is being written at this moment, or a process was killed while it wrote.
    """
    named = _TEMPORARY.fullmatch(temporary.name)
    return named["target"] if named else ""
