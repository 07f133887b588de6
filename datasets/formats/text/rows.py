"""Text files as rows of which only some cells are changed."""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from dataclasses import dataclass
from sys import intern

import numpy as np

from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.text.cells import CellSplitter
from mocapbench.datasets.formats.text.numbers import (
    format_number,
    is_missing,
    is_number,
    looks_numeric,
    numeric,
)
from mocapbench.datasets.recording import FrameByChannel, Mask

__all__ = ["SpacedTable", "TextTable"]


@dataclass(frozen=True)
class TextTable:
    """Rows of as many cells each, below a head; blank lines may follow them.

    Parameters
    ----------
    file : str
        Name of the file in errors.
    lines : sequence of str
        The lines of the file.
    start : int
        Index of the first row.
    cells : CellSplitter
        How cells are told apart.
    width : int
        Cells of a row.
    shortest : int
        Cells that a row has at least, if the empty ones at its end may be left out.
    decimal : str
        The decimal mark, a point or a comma.
    names : sequence of str
        Of the columns, for errors; without them, columns are counted from 1.
    """

    file: str
    lines: Sequence[str]
    start: int
    cells: CellSplitter
    width: int
    shortest: int
    decimal: str = "."
    names: Sequence[str] = ()

    @property
    def rows(self) -> Sequence[int]:
        """Indices of the lines that are rows: all up to those at the end that are blank."""
        stop = len(self.lines)
        while stop > self.start and not self.lines[stop - 1].strip():
            stop -= 1
        return range(self.start, stop)

    def name_row(self, row: int) -> str:
        """Return what messages call a row."""
        return f"line {self.line_of(row)}"

    def line_of(self, row: int) -> int:
        """Return the line of a row, counted from 1."""
        return self.rows[row] + 1

    def row(self, index: int) -> list[str]:
        """Return the cells of the line at ``index``.

        Raises
        ------
        FormatError
            If they are too many or too few.
        """
        cells = self.cells.split(self.lines[index])
        n_cells = len(cells)
        if n_cells < self.width:
            cells += [""] * (self.width - n_cells)
        if n_cells < self.shortest or any(cell.strip() for cell in cells[self.width :]):
            advice = "export the recording again, in whole"
            got = f"{n_cells} cells"
            raise FormatError(self.file, f"{self.width} cells", got, advice, index + 1)
        return cells

    def numbers(self, columns: Sequence[int]) -> FrameByChannel:
        """Return the numbers of some columns, (N, columns), NaN where a cell is missing.

        Raises
        ------
        FormatError
            If a row has not all cells, or one of the cells is not a number.
        """
        values = array("d")  # lists would take four times the memory
        for index in self.rows:
            row = self.row(index)
            try:
                values.extend(numeric([row[column] for column in columns], self.decimal))
            except ValueError:
                raise self._not_a_number(row, columns, index) from None
        return np.frombuffer(values, dtype=np.float64).reshape(-1, len(columns))

    def texts(self, columns: Sequence[int]) -> dict[int, list[str]]:
        """Return the cells of some columns, of which equal ones take memory once."""
        cells: dict[int, list[str]] = {column: [] for column in columns}
        for index in self.rows:
            row = self.row(index)
            for column in columns:
                cells[column].append(intern(row[column]))
        return cells

    def with_numbers(self, columns: Sequence[int], values: FrameByChannel, new: Mask) -> list[str]:
        """Return the lines of the file with the ``new`` (N, columns) cells replaced."""
        lines, indices = list(self.lines), self.rows
        for row in np.flatnonzero(new.any(axis=1)).tolist():
            places = np.flatnonzero(new[row]).tolist()
            cells = {columns[k]: format_number(values[row, k], self.decimal) for k in places}
            index = indices[row]
            lines[index] = self.cells.replace_cells(lines[index], cells)
        return lines

    def _not_a_number(self, row: Sequence[str], columns: Sequence[int], index: int) -> FormatError:
        wrong = next(column for column in columns if self._is_wrong(row[column]))
        expected, advice = "a number", "correct the cell, or leave it empty if the value is missing"
        if looks_numeric(row[wrong]):
            expected = f"a number such as 1{self.decimal}5 or -1000"
            advice = "write all numbers of the file so, without other marks"
        column = repr(self.names[wrong]) if self.names else wrong + 1
        got = f"{row[wrong][:60]!r} in column {column}"
        return FormatError(self.file, expected, got, advice, index + 1)

    def _is_wrong(self, cell: str) -> bool:
        return not (is_missing(cell) or is_number(cell, self.decimal))


class SpacedTable(TextTable):
    """Rows among which lines may be blank."""

    @property
    def rows(self) -> Sequence[int]:
        """Indices of the lines that are rows."""
        return [k for k in super().rows if self.lines[k].strip()]
