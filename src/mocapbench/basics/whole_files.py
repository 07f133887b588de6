"""Files that are written whole or not at all, one or several together.

They are written beside their places first. What a killed process leaves there goes at the next
start of one that writes there: see `mocapbench.basics.temporaries`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from functools import cache
from pathlib import Path
from typing import IO

from mocapbench.basics.temporaries import (
    PREFIX,
    final_place,
    sweep,
    temporary_file,
    temporary_folder,
)
from mocapbench.basics.transactions import decide, draft_folder
from mocapbench.basics.words import encodable

__all__ = [
    "LONGEST_NAME",
    "atomic_write",
    "encode_text",
    "stage_file",
    "write_bytes",
    "write_files",
    "write_text",
    "write_together",
]

LONGEST_NAME = 255 - len(PREFIX)
"""In bytes, of what file systems take, with room for what `write_together` puts before a name."""


@contextmanager
def stage_file(path: Path) -> Iterator[Path]:
    """Yield an empty file beside ``path``, which takes the place ``path`` if nothing goes wrong."""
    _sweep_once(path.parent)
    with _name_in_errors(path), temporary_file(path.parent) as staged:
        yield staged
        staged.replace(path)


@contextmanager
def write_together(folder: Path, name: str, obsolete: Iterable[str] = ()) -> Iterator[Path]:
    """Yield a folder; the files written there take their places in ``folder`` together at the end.

    If anything goes wrong, none does. If the process is killed, either none does or all do by the
    next `sweep` of ``folder``.

    Parameters
    ----------
    folder : Path
    name : str
        Of what is written: two processes cannot write what has one name at the same time.
    obsolete : iterable of str, optional
        Names of files in ``folder`` that are deleted with it.

    Raises
    ------
    BlockingIOError
        If another process is writing it.
    """
    sweep(folder)
    with _name_in_errors(folder / name), temporary_folder(folder, name) as held:
        yield draft_folder(held, obsolete)
        decide(held)


def write_files(contents: Mapping[Path, bytes]) -> None:
    """Write files together; those of several folders are all drafted before any takes its place."""
    by_folder: dict[Path, dict[str, bytes]] = {}
    for path, content in contents.items():
        by_folder.setdefault(path.parent, {})[path.name] = content
    with ExitStack() as transactions:
        for folder, named in by_folder.items():
            drafts = transactions.enter_context(write_together(folder, min(named)))
            for name, content in named.items():
                (drafts / name).write_bytes(content)


@contextmanager
def atomic_write(path: Path) -> Iterator[IO[bytes]]:
    """Open a file that takes the name ``path`` only when all is written."""
    with stage_file(path) as staged, staged.open("wb") as file:
        yield file


def encode_text(text: str) -> bytes:
    """Return a text as files have it: in UTF-8, lone surrogates escaped."""
    return encodable(text).encode()


def write_text(path: Path, text: str) -> None:
    """Write ``text``, encoded by `encode_text`, whole or not at all."""
    write_bytes(path, encode_text(text))


def write_bytes(path: Path, content: bytes) -> None:
    """Write ``content`` whole or not at all."""
    with atomic_write(path) as file:
        file.write(content)


@contextmanager
def _name_in_errors(path: Path) -> Iterator[None]:
    """Have errors of the system name a file that people know, where they name none or a draft."""
    try:
        yield
    except OSError as error:
        if error.errno is not None and PREFIX in (error.filename or PREFIX):
            error.filename = str(final_place(path))
        raise


@cache
def _sweep_once(folder: Path) -> None:
    """Sweep a folder, unless this process has: many files may be written there."""
    sweep(folder)
