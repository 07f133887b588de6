"""The text of an Acclaim file: bounded reading, and lines with file and number for errors."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from math import isfinite
from pathlib import Path
from typing import BinaryIO

from mocapbench.datasets.acclaim.errors import AcclaimError

__all__ = ["MAX_LINE", "Line", "content_lines", "finite_floats", "read_text"]

MAX_LINE = 4096
"""Longest line in bytes that is accepted; the CMU database has lines of about a hundred."""

_SHOWN = 60
_HUGE = 1e100  # far from where arithmetic on the values could overflow


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
        raise ValueError(f"expected finite numbers, got {words}")
    return values


@dataclass(frozen=True)
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
        shown = self.text if len(self.text) <= _SHOWN else self.text[:_SHOWN] + "…"
        return AcclaimError(self.file, self.number, expected, repr(shown))

    def floats(self, start: int, stop: int) -> tuple[float, ...]:
        """Return the words from ``start`` to ``stop`` (exclusive) as finite numbers.

        Raises
        ------
        AcclaimError
            If there are fewer words, or one is not a finite number.
        """
        words = self.words[start:stop]
        expected = f"{self.words[0]!r} with {stop - start} finite numbers"
        if len(words) != stop - start:
            raise self.error(expected)
        try:
            return tuple(finite_floats(words))
        except ValueError:
            raise self.error(expected) from None


def content_lines(text: str, file: str) -> Iterator[Line]:
    """Yield the lines that are neither blank nor a comment."""
    for number, line in enumerate(text.split("\n"), 1):
        if line.strip() and not line.lstrip().startswith("#"):
            yield Line(file, number, line.rstrip())


def read_text(path: str | Path) -> str:
    """Return the text of a file, without loading any line longer than `MAX_LINE` bytes.

    Raises
    ------
    AcclaimError
        If the file cannot be opened, has an over-long line, is empty or is not UTF-8.
    """
    file = str(path)
    try:
        with Path(path).open("rb") as stream:
            data = b"".join(_bounded_lines(stream, file))
    except OSError as problem:
        raise AcclaimError(file, None, "a readable file", str(problem)) from problem
    if not data.strip():
        raise AcclaimError(file, None, "an Acclaim file", "an empty file")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as problem:
        line = data.count(b"\n", 0, problem.start) + 1
        got = f"the byte {data[problem.start]:#04x}"
        raise AcclaimError(file, line, "UTF-8 text", got) from problem


def _bounded_lines(stream: BinaryIO, file: str) -> Iterator[bytes]:
    for number, line in enumerate(iter(partial(stream.readline, MAX_LINE + 1), b""), 1):
        if len(line) > MAX_LINE:
            expected = f"a line of at most {MAX_LINE} bytes"
            raise AcclaimError(file, number, expected, "a longer one")
        yield line
