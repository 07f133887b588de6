"""The text of an Acclaim file: bounded reading, and lines with file and number for errors.

Lines are taken from the text one after another: a list of all of them would need up to 30 times the
memory of the text, as every short string has a header of its own.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from io import StringIO
from math import isfinite
from pathlib import Path
from typing import BinaryIO

from mocapbench.datasets.acclaim.errors import AcclaimError
from mocapbench.datasets.encoding import MARK, decode_text, foreign_encoding

__all__ = [
    "FINITE_NUMBERS",
    "MAX_LINE",
    "Line",
    "content_lines",
    "finite_floats",
    "name_list",
    "read_text",
]

MAX_LINE = 4096
"""Longest line in bytes that is accepted; the CMU database has lines of about a hundred."""

_LONG_LINE = re.compile(rb"^[^\n]{%d}" % MAX_LINE, re.MULTILINE)
_CHUNK = 2**16
_SHOWN = 60
_SHOWN_NAMES = 400  # all segments of the CMU database's skeletons
_HUGE = 1e100  # far from where arithmetic on the values could overflow

FINITE_NUMBERS = f"finite numbers, {-_HUGE:g} to {_HUGE:g}"
"""What `finite_floats` accepts, for errors."""


def finite_floats(words: Sequence[str]) -> list[float]:
    """Return the words as numbers.

    Raises
    ------
    ValueError
        If one is not a number in plain notation, is NaN, or is too large to be a measurement.
    """
    values = [float(word) for word in words]
    # float() also accepts Python's 1_000 and the digits of other scripts; the format does not.
    joined = "".join(words)
    plain = joined.isascii() and "_" not in joined
    if not plain or not all(map(isfinite, values)) or max(map(abs, values), default=0.0) > _HUGE:
        raise ValueError(f"expected {FINITE_NUMBERS}, got {words}")
    return values


@dataclass(frozen=True, slots=True)
class Line:
    """One line of a file.

    Parameters
    ----------
    file : str
        The file of the line, for error messages.
    number : int
        Counted from 1.
    text : str
        The line without its line end.
    """

    file: str
    number: int
    text: str

    @property
    def words(self) -> tuple[str, ...]:
        """The line, split at white space."""
        return tuple(self.text.split())

    def error(self, expected: str) -> AcclaimError:
        """Return an error for this line, given what was expected."""
        return AcclaimError(self.file, self.number, expected, repr(_beginning(self.text, _SHOWN)))

    def floats(self, start: int, stop: int) -> tuple[float, ...]:
        """Return the words from ``start`` to ``stop`` (exclusive) as finite numbers.

        Raises
        ------
        AcclaimError
            If there are fewer words, or one is not a finite number.
        """
        words = self.words[start:stop]
        if len(words) == stop - start:
            with suppress(ValueError):
                return tuple(finite_floats(words))
        # Not in the clause: an error keeps the one before it, and with that the parser's frames.
        raise self.error(f"{self.words[0]!r} with {stop - start} {FINITE_NUMBERS}")


def content_lines(text: str, file: str) -> Iterator[Line]:
    """Yield the lines that are neither blank nor a comment."""
    for number, line in enumerate(StringIO(text), 1):
        if line.strip() and not line.lstrip().startswith("#"):
            yield Line(file, number, line.rstrip())


def name_list(names: Iterable[str]) -> str:
    """Return the names with commas between them, or their beginning if they are many."""
    return _beginning(", ".join(names), _SHOWN_NAMES)


def read_text(path: str | Path, max_bytes: int) -> str:
    """Return the text of a file, without loading more than is accepted.

    Parameters
    ----------
    path : path
        The file.
    max_bytes : int
        Size of the largest file that is accepted; of its lines, none may exceed `MAX_LINE` bytes.

    Raises
    ------
    AcclaimError
        If the file cannot be opened, is too large, has an over-long line, is empty, has a
        NUL byte, or is in another encoding.
    """
    file = str(path)
    try:
        with Path(path).open("rb") as stream:
            data = b"".join(_chunks(stream, max_bytes))
    except OSError as problem:
        raise AcclaimError(file, None, "a readable file", str(problem)) from problem
    foreign = foreign_encoding(data[:MAX_LINE])
    if foreign:
        raise AcclaimError(file, None, "text in UTF-8 or Windows-1252", foreign)
    _require_bounded(data, file, max_bytes)
    if not data or data.isspace():
        raise AcclaimError(file, None, "an Acclaim file", "an empty file")
    if b"\0" in data:
        number = data.count(b"\n", 0, data.index(b"\0")) + 1
        raise AcclaimError(file, number, "text in UTF-8 or Windows-1252", "a NUL byte")
    return decode_text(data).removeprefix(MARK)


def _chunks(stream: BinaryIO, max_bytes: int) -> Iterator[bytes]:
    """Yield the content of a stream, not much more of it than is accepted."""
    size = 0
    while size <= max_bytes and (chunk := stream.read(_CHUNK)):
        size += len(chunk)
        yield chunk


def _require_bounded(data: bytes, file: str, max_bytes: int) -> None:
    long = _LONG_LINE.search(data)
    if long:
        number = data.count(b"\n", 0, long.start()) + 1
        raise AcclaimError(file, number, f"a line of at most {MAX_LINE} bytes", "a longer one")
    if len(data) > max_bytes:
        expected = f"a file of at most {max_bytes / 2**20:g} MiB"
        raise AcclaimError(file, None, expected, "a larger one")


def _beginning(text: str, length: int) -> str:
    return text if len(text) <= length else text[:length] + "…"
