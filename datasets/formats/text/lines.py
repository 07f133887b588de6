"""Lines of text files with their ends, read and written byte for byte."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mocapbench.datasets.encoding import MARK, encoding_of, foreign_encoding
from mocapbench.datasets.formats.errors import FormatError

__all__ = ["read_lines", "write_lines"]

_ADVICE = "save it as text in UTF-8"
_TEXT = "text in UTF-8, in Windows-1252, or in UTF-16 or UTF-32 with a byte order mark"
_START = 4096  # bytes by which text is told from other files
_WITHOUT = dict.fromkeys(["UTF-16", "UTF-32"], " without that mark")


def read_lines(path: Path) -> list[str]:
    """Return the lines of a text file with their ends, without a byte order mark.

    Lines end with LF or CR LF, or, if there is no LF in the file, with CR.

    Raises
    ------
    FormatError
        If it is not in the encoding that its byte order mark names, is in another that nothing
        names, or a line has a NUL byte.
    """
    encoding = encoding_of(path)
    try:
        lines = _split_file(path, encoding, "\n")
        if len(lines) == 1 and "\r" in lines[0].rstrip("\r\n"):
            lines = _split_file(path, encoding, "\r")
    except UnicodeDecodeError as error:
        expected = f"text in {encoding.upper()}, as its byte order mark says"
        raise FormatError(path.name, expected, error.reason, _ADVICE) from error
    _check_encoding(path, encoding)
    for number, line in enumerate(lines, start=1):
        if "\0" in line:
            raise FormatError(path.name, _TEXT, "a NUL byte", _ADVICE, number)
    return [line.removeprefix(MARK) for line in lines[:1]] + lines[1:]


def write_lines(path: Path, lines: Sequence[str], like: Path) -> None:
    """Write lines that have their ends in the encoding of a file, the inverse of `read_lines`."""
    encoding = encoding_of(like)
    with like.open(encoding=encoding) as given:
        mark = given.read(1) == MARK
    with path.open("w", encoding=encoding, newline="\n") as file:
        file.write(MARK * mark)
        file.writelines(lines)


def _split_file(path: Path, encoding: str, end: str) -> list[str]:
    with path.open(encoding=encoding, newline=end) as file:
        return file.readlines()


def _check_encoding(path: Path, encoding: str) -> None:
    """Refuse text in an encoding that nothing in the file names."""
    if encoding.startswith("utf-") and encoding != "utf-8":
        return
    with path.open("rb") as file:
        name = foreign_encoding(file.read(_START))
    if name:
        raise FormatError(path.name, _TEXT, f"{name}{_WITHOUT.get(name, '')}", _ADVICE)
