"""What a table of text has between its columns, and within its numbers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mocapbench.datasets.formats.text.cells import CellSplitter, Separated, Words
from mocapbench.datasets.formats.text.numbers import looks_numeric

__all__ = ["Notation", "notation_of"]

_SEPARATORS = ("\t", ";", ",")
_POINT, _COMMA = ".", ","


Notation = tuple[CellSplitter, str]
"""How cells are told apart, and the decimal mark, a point or a comma."""


def notation_of(lines: Sequence[str], *, by_blanks: bool = False) -> Notation:
    """Return the notation of the line that names the columns and those below.

    Between columns is what divides the first line into most cells, and of several such the one that
    divides the second line likewise. Where it is not a comma, the first number with a decimal mark
    says which one the file has; without any, it is a comma between semicolons, where files with
    points have commas.

    Parameters
    ----------
    lines : sequence of str
    by_blanks : bool
        Whether blanks divide a line without any separator.
    """
    separator = _separator(lines)
    cells = Separated(separator)
    if by_blanks and len(cells.split(lines[0].rstrip())) == 1:
        return Words(), next(_decimal_marks(Words(), lines), _POINT)
    if separator == _COMMA:
        return cells, _POINT
    default = _COMMA if separator == ";" else _POINT
    return cells, next(_decimal_marks(cells, lines), default)


def _separator(lines: Sequence[str]) -> str:
    def fit(separator: str) -> tuple[int, bool]:
        first, *second = (len(Separated(separator).split(line)) for line in lines[:2])
        return first, [first] == second

    best = max(_SEPARATORS, key=fit)
    return best if fit(best)[0] > 1 else _COMMA


def _decimal_marks(cells: CellSplitter, lines: Sequence[str]) -> Iterator[str]:
    """Yield the last point or comma of each number that has one."""
    for line in lines[1:]:
        for cell in cells.split(line) if _POINT in line or _COMMA in line else ():
            mark = max(_POINT, _COMMA, key=cell.rfind)
            if mark in cell and looks_numeric(cell):
                yield mark
