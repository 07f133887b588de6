"""Lines of text files with their ends, read and written byte for byte."""

from __future__ import annotations

import codecs
from collections.abc import Sequence
from pathlib import Path

__all__ = ["read_lines", "write_lines"]

_MARKS = {  # that of UTF-32 begins with that of UTF-16, and comes first
    codecs.BOM_UTF32_LE: "utf-32-le",
    codecs.BOM_UTF32_BE: "utf-32-be",
    codecs.BOM_UTF16_LE: "utf-16-le",
    codecs.BOM_UTF16_BE: "utf-16-be",
}


def read_lines(path: Path) -> list[str]:
    """Return the lines of a text file with their ends.

    It is UTF-8 unless it begins with the byte order mark of UTF-16 or UTF-32. The mark stays part
    of the first line, and bytes that are not UTF-8 are kept.
    """
    encoding, errors = _encoding(path)
    with path.open(encoding=encoding, errors=errors, newline="\n") as file:
        return file.readlines()


def write_lines(path: Path, lines: Sequence[str], like: Path) -> None:
    """Write lines that have their ends in the encoding of a file, the inverse of `read_lines`."""
    encoding, errors = _encoding(like)
    with path.open("w", encoding=encoding, errors=errors, newline="\n") as file:
        file.writelines(lines)


def _encoding(path: Path) -> tuple[str, str]:
    """Return the encoding of a file, and how to treat what is not text in it."""
    with path.open("rb") as file:
        start = file.read(4)
    for mark, encoding in _MARKS.items():
        if start.startswith(mark):
            return encoding, "surrogatepass"
    return "utf-8", "surrogateescape"
