"""Text files as lines with their ends, and rows of which only some cells are changed.

A file is written as the lines that were read, byte for byte, but for the cells that are new.
"""

from __future__ import annotations

import re
from array import array
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.text.numbers import is_missing, numeric, written
from mocapbench.datasets.recording import FrameByChannel, Mask

__all__ = ["Cells", "Separated", "Table", "Words", "read_lines", "write_lines"]

_ENDS = "\r\n"
_BYTE_ORDER_MARK = "\ufeff"


def read_lines(path: Path) -> list[str]:
    """Return the lines of a text file with their ends; bytes that are not UTF-8 are kept."""
    with path.open(encoding="utf-8", errors="surrogateescape", newline="\n") as file:
        return file.readlines()


def write_lines(path: Path, lines: Sequence[str]) -> None:
    """Write lines that have their ends, the inverse of `read_lines`."""
    with path.open("w", encoding="utf-8", errors="surrogateescape", newline="\n") as file:
        file.writelines(lines)


class Cells(Protocol):
    """How the cells of a row are told apart."""

    def split(self, line: str) -> list[str]:
        """Return the cells of a line."""

    def replaced(self, line: str, new: Mapping[int, str]) -> str:
        """Return the line with the cells of some indices replaced."""


@dataclass(frozen=True)
class Separated:
    """Cells between separators; those within double quotes belong to the cell.

    Parameters
    ----------
    separator : str
        One character.
    """

    separator: str

    def split(self, line: str) -> list[str]:
        """Return the cells of a line, without quotes and the blanks around."""
        text = line.removeprefix(_BYTE_ORDER_MARK)
        if '"' not in text:
            return text.rstrip(_ENDS).split(self.separator)
        return [cell.strip().strip('"') for cell in self._quoted(text)]

    def replaced(self, line: str, new: Mapping[int, str]) -> str:
        """Return the line with the cells of some indices replaced; a short line is lengthened."""
        body = line.rstrip(_ENDS)
        cells = self._quoted(body)
        cells += [""] * (1 + max(new) - len(cells))
        for index, cell in new.items():
            cells[index] = cell
        return self.separator.join(cells) + line[len(body) :]

    def _quoted(self, line: str) -> list[str]:
        cells: list[str] = []
        for piece in line.rstrip(_ENDS).split(self.separator):
            if cells and cells[-1].count('"') % 2:
                cells[-1] += self.separator + piece
            else:
                cells.append(piece)
        return cells


class Words:
    """Cells between blanks."""

    def split(self, line: str) -> list[str]:
        """Return the words of a line."""
        return line.split()

    def replaced(self, line: str, new: Mapping[int, str]) -> str:
        """Return the line with the words of some indices replaced, and all blanks as they were."""
        words = re.findall(r"\s*\S+", line)
        end = line[sum(map(len, words)) :]
        for index, word in new.items():
            words[index] = words[index].removesuffix(words[index].lstrip()) + word
        return "".join(words) + end


@dataclass(frozen=True)
class Table:
    """Rows of as many cells each, below a head; blank lines may follow them.

    Parameters
    ----------
    file : str
        Name of the file in errors.
    lines : sequence of str
        The lines of the file.
    start : int
        Index of the first row.
    cells : Cells
        How cells are told apart.
    width : int
        Cells of a row.
    shortest : int
        Cells that a row has at least, if the empty ones at its end may be left out.
    """

    file: str
    lines: Sequence[str]
    start: int
    cells: Cells
    width: int
    shortest: int

    @property
    def stop(self) -> int:
        """Index after the last row."""
        end = len(self.lines)
        while end > self.start and not self.lines[end - 1].strip():
            end -= 1
        return end

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
        for index in range(self.start, self.stop):
            row = self.row(index)
            chosen = [row[column] for column in columns]
            try:
                values.extend(numeric(chosen))
            except ValueError:
                raise self._not_a_number(chosen, index) from None
        return np.frombuffer(values, dtype=np.float64).reshape(-1, len(columns))

    def with_numbers(self, columns: Sequence[int], values: FrameByChannel, new: Mask) -> list[str]:
        """Return the lines of the file with the ``new`` (N, columns) cells replaced."""
        lines = list(self.lines)
        for row in np.flatnonzero(new.any(axis=1)).tolist():
            cells = {columns[k]: written(values[row, k]) for k in np.flatnonzero(new[row]).tolist()}
            lines[self.start + row] = self.cells.replaced(lines[self.start + row], cells)
        return lines

    def _not_a_number(self, cells: Sequence[str], index: int) -> FormatError:
        wrong = next(filter(_is_wrong, cells))
        advice = "correct the cell, or leave it empty if the value is missing"
        return FormatError(self.file, "a number", repr(wrong[:60]), advice, index + 1)


def _is_wrong(cell: str) -> bool:
    try:
        numeric([cell])
    except ValueError:
        return not is_missing(cell)
    return False
