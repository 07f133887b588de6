"""Files that are written whole or not at all."""

from __future__ import annotations

import re
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from mocapbench.basics.words import encodable

__all__ = ["LONGEST_NAME", "atomic_write", "stage_file", "target_of", "write_bytes", "write_text"]

_SUFFIX = ".tmp"
LONGEST_NAME = 255 - len("..12345678") - len(_SUFFIX)
"""In bytes, of what file systems take, with room for what `stage_file` puts around a name."""
_TEMPORARY = re.compile(r"\.(?P<target>.+)\.[a-z0-9]{8}\.tmp")
"""The names that `stage_file` gives."""


@contextmanager
def stage_file(path: Path) -> Iterator[Path]:
    """Yield an empty file beside ``path``, which takes its name if nothing goes wrong.

    A process that is killed leaves no part of the file under its name. Who may read it is as the
    user's umask says, which `tempfile` does not ask.
    """
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}{_SUFFIX}")
    temporary.touch(exist_ok=False)
    try:
        yield temporary
        temporary.replace(path)
    except OSError as error:
        if error.errno is not None and error.filename is None:  # as errors of writing have it
            error.filename = str(path)
        raise
    finally:
        temporary.unlink(missing_ok=True)


@contextmanager
def atomic_write(path: Path) -> Iterator[IO[bytes]]:
    """Open a file that takes the name ``path`` only when all is written."""
    with stage_file(path) as temporary, temporary.open("wb") as file:
        yield file


def write_text(path: Path, text: str) -> None:
    """Write ``text`` as UTF-8, whole or not at all; lone surrogates are escaped."""
    write_bytes(path, encodable(text).encode())


def write_bytes(path: Path, content: bytes) -> None:
    """Write ``content`` whole or not at all."""
    with atomic_write(path) as file:
        file.write(content)


def target_of(temporary: Path) -> str:
    """Return the name that `stage_file` meant a file for; nothing if the file is not its own.

    Such a file is being written at this moment, or a process was killed while it wrote.
    """
    named = _TEMPORARY.fullmatch(temporary.name)
    return named["target"] if named else ""
