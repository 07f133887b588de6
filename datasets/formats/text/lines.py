"""Lines of text files with their ends, read and written byte for byte."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mocapbench.datasets.encoding import MARK, encoding_of
from mocapbench.datasets.formats.errors import FormatError

__all__ = ["read_lines", "write_lines"]

_ADVICE = "save it as text in UTF-8"


def read_lines(path: Path) -> list[str]:
    """Return the lines of a text file with their ends, without a byte order mark.

    Raises
    ------
    FormatError
        If it is not in the encoding that its byte order mark names, or a line has a NUL byte.
    """
    encoding = encoding_of(path)
    try:
        with path.open(encoding=encoding, newline="\n") as file:
            lines = file.readlines()
    except UnicodeDecodeError as error:
        expected = f"text in {encoding.upper()}, as its byte order mark says"
        raise FormatError(path.name, expected, error.reason, _ADVICE) from error
    for number, line in enumerate(lines, start=1):
        if "\0" in line:
            expected = "text in UTF-8, or in UTF-16 with a byte order mark"
            raise FormatError(path.name, expected, "a NUL byte", _ADVICE, number)
    return [line.removeprefix(MARK) for line in lines[:1]] + lines[1:]


def write_lines(path: Path, lines: Sequence[str], like: Path) -> None:
    """Write lines that have their ends in the encoding of a file, the inverse of `read_lines`."""
    encoding = encoding_of(like)
    with like.open(encoding=encoding) as given:
        mark = given.read(1) == MARK
    with path.open("w", encoding=encoding, newline="\n") as file:
        file.write(MARK * mark)
        file.writelines(lines)
