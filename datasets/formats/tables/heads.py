"""The head of a table: where its rows are, and what its columns are called.

A table of a program that `DIALECTS` describes is known by its first lines. If its head does not go
on as that program writes it, the table is a damaged one, and is refused by that name. All other
tables have the names of their columns in the first line.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import isfinite

from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.tables.columns import is_index
from mocapbench.datasets.formats.tables.dialects import DIALECTS, PLAIN, Dialect, Place
from mocapbench.datasets.formats.tables.header import check_lines, column_names
from mocapbench.datasets.formats.tables.labels import Label, expand_parts, label_columns
from mocapbench.datasets.formats.tables.notation import Notation, notation_of
from mocapbench.datasets.formats.text.cells import CellSplitter, Parts

__all__ = ["Head", "read_head"]

_LONGEST = 300
"""Lines that a head has at most."""
_AROUND = re.compile(r'[ "]*([,;\t])[ "]*')
_ABOVE = re.compile(r'[ ,;\t\r\n"]*(?:sep=.)?[ ,;\t\r\n"]*', re.IGNORECASE)
"""Lines above a head: blank ones, and the one that tells Excel what separates cells."""


@dataclass(frozen=True)
class Head:
    """What stands above the rows of a table.

    Parameters
    ----------
    dialect : Dialect
    notation : Notation
    start, stop : int
        The lines [start, stop) of the rows.
    labels : list of Label
        One for each column.
    rate, n_rows : float or None
        Frames per second, and how many rows there should be.
    """

    dialect: Dialect
    notation: Notation
    start: int
    stop: int
    labels: list[Label]
    rate: float | None = None
    n_rows: float | None = None


def read_head(file: str, lines: Sequence[str]) -> Head:
    """Return the head of a table.

    Raises
    ------
    FormatError
        If the file is empty, or its head is not whole.
    """
    check_lines(file, lines)
    top = next((k for k, line in enumerate(lines) if not _ABOVE.fullmatch(line)), 0)
    dialect = _find_dialect(file, _join(lines[top : top + _LONGEST]))
    if dialect.no_motion:
        what, _, advice = dialect.no_motion.partition(": ")
        got = f"{what} of {dialect.program}"
        raise FormatError(file, "positions or angles of a recording", got, advice, top + 1)
    if dialect is not PLAIN:
        return _HeadLines(file, lines, dialect, top).head()
    notation = notation_of(lines[top:])
    labels = [Label(name) for name in column_names(file, lines, top, notation[0])]
    stop = _end_of_rows(lines, top + 1, len(lines), labels)
    return Head(PLAIN, notation, top + 1, stop, labels)


def _find_dialect(file: str, text: str) -> Dialect:
    """Return the first dialect whose sign a text has, or whose suffix its file."""
    name = file.lower()
    fitting = (one for one in DIALECTS if re.match(one.sign, text) or name.endswith(one.suffixes))
    return next(fitting, PLAIN)


def _join(lines: Sequence[str]) -> str:
    """Return plain lines as one text in which each ends with a line feed alone."""
    return "".join(f"{_plain(line)}\n" for line in lines)


def _plain(line: str) -> str:
    """Return a line without its end, and without quotes and blanks around its cells."""
    bare = line.strip(' "\r\n')
    return _AROUND.sub(r"\1", bare) if " " in bare or '"' in bare else bare  # rows are long


def _end_of_rows(lines: Sequence[str], start: int, stop: int, labels: Sequence[Label]) -> int:
    """Return the index after the last row.

    Lines of separators alone are rows, of frames in which nothing is visible, only if no column
    counts frames or times: spreadsheets add such lines.
    """
    blank = ' ,;\t\r\n"' if any(is_index(label.name) for label in labels) else None
    while stop > start and not lines[stop - 1].strip(blank):
        stop -= 1
    return stop


def _is_blank(line: str) -> bool:
    return not line.strip(' ,;\t\r\n"')


class _HeadLines:
    """The lines of a head, found by what a dialect says of them."""

    def __init__(self, file: str, lines: Sequence[str], dialect: Dialect, top: int) -> None:
        self.file, self.lines, self.dialect = file, lines, dialect
        self.first = self._first(top)
        self.last = self._last()
        self.text = _join(lines[self.first : self.last + 1])

    def head(self) -> Head:
        """Return what they say."""
        rows = range(self.last + 1, len(self.lines))
        start = next((k for k in rows if self.lines[k].strip(" \r\n")), len(self.lines))
        stop = self._stop(start)
        naming = self.lines[self._naming_line()]
        cells, decimal = notation_of([naming, *self.lines[start:stop]], by_blanks=True)
        axes = self._axes(cells, start)
        others = {
            name: self._cells(cells, getattr(self.dialect, name), len(axes))
            for name in ("names", "kinds", "groups", "units")
        }
        labels = label_columns(self.dialect, {"axes": axes, **others}, self._fact)
        parted = expand_parts(labels, self._fact(self.dialect.parts))
        if len(parted) > len(labels):
            cells = Parts(f"{cells.separator},")
        rate, n_rows = self._number(self.dialect.rate), self._number(self.dialect.rows)
        stop = _end_of_rows(self.lines, start, stop, parted)
        return Head(self.dialect, (cells, decimal), start, stop, parted, rate, n_rows)

    def _first(self, top: int) -> int:
        """Return the line with which the block begins that is to be read."""
        for title in self.dialect.blocks:
            pattern = re.compile(rf'[ "]*{title}[,;\t \r\n"]*$', re.IGNORECASE)
            for index, line in enumerate(self.lines):
                if pattern.match(line):
                    return index
        if not self.dialect.blocks:
            return top
        titles = " or ".join(self.dialect.blocks)
        expected = f"a block {titles} in a table of {self.dialect.program}"
        got = repr(self.lines[top].strip(' ,;\t\r\n"')[:60])
        raise FormatError(
            self.file, expected, f"{got} only", "export the trajectories too", top + 1
        )

    def _last(self) -> int:
        """Return the last line of the head."""
        found = self._find(self.dialect.ends, len(self.lines))
        if found is None:
            got = f"none in the first {min(_LONGEST, len(self.lines) - self.first)} lines"
            raise self._damaged(f"the line {self.dialect.ends_with!r}", got)
        for index in self._filled(found + 1):
            if not re.match(self.dialect.further, _plain(self.lines[index])):
                break
            found = index
        return found

    def _stop(self, start: int) -> int:
        """Return the end of the lines below the head, or of the first of several blocks."""
        end = len(self.lines)
        if not self.dialect.blocks:
            return end
        return next((k for k in range(start, end) if _is_blank(self.lines[k])), end)

    def _naming_line(self) -> int:
        """Return the line that names the columns, or else the markers."""
        for pattern in (self.dialect.columns, self.dialect.listed):
            found = self._find(pattern, self.last + 1)
            if found is not None:
                return found
        expected = "a line that names the columns"
        raise self._damaged(expected, repr(self.lines[self.last].strip()[:60]))

    def _axes(self, cells: CellSplitter, start: int) -> list[str]:
        """Return the cells of the line that names the columns, or those that it would have."""
        line = self._naming_line()
        found = [cell.strip() for cell in cells.split(self.lines[line])]
        if re.match(self.dialect.columns, _plain(self.lines[line])):
            return found
        axes = [f"{name} {axis}" for name in found[1:] if name for axis in "XYZ"]
        below = cells.split(self.lines[start].rstrip()) if start < len(self.lines) else []
        counted = len(below) == len(axes) + 2  # a frame and a time that no line names
        return [*["Frame", "Time"][: 2 * counted], *axes]

    def _cells(self, cells: CellSplitter, place: Place, width: int) -> list[str]:
        """Return the cells of another line of the head, as many as there are columns."""
        pattern, below = place
        found = self._find(pattern, self.last + 1)
        if found is None or not self.first <= found + below <= self.last:
            return []
        row = [cell.strip() for cell in cells.split(self.lines[found + below])]
        return (row + [""] * width)[:width]

    def _fact(self, pattern: str) -> str:
        found = re.search(pattern, self.text)
        return found[1] if found else ""

    def _number(self, pattern: str) -> float | None:
        with suppress(ValueError):
            number = float(self._fact(pattern).replace(",", "."))
            return number if isfinite(number) and number > 0 else None
        return None

    def _find(self, pattern: str, stop: int) -> int | None:
        within = range(self.first, min(stop, self.first + _LONGEST))
        return next((k for k in within if re.match(pattern, _plain(self.lines[k]))), None)

    def _filled(self, start: int) -> Iterator[int]:
        return (k for k in range(start, len(self.lines)) if not _is_blank(self.lines[k]))

    def _damaged(self, expected: str, got: str) -> FormatError:
        return FormatError(
            self.file,
            f"{expected} in a table of {self.dialect.program}",
            got,
            "its head may be cut short: export the recording again, with the whole head",
            self.first + 1,
        )
