"""What a file of separated values has between its columns, and within its numbers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from mocapbench.datasets.formats.text.cells import Separated
from mocapbench.datasets.formats.text.numbers import looks_numeric

__all__ = ["Dialect", "dialect_of"]

_SEPARATORS = ("\t", ";", ",")
_POINT, _COMMA = ".", ","


class Dialect(NamedTuple):
    """How a file is written."""

    cells: Separated
    decimal: str
    """The decimal mark, a point or a comma."""


def dialect_of(lines: Sequence[str]) -> Dialect:
    """Return the dialect of a file's lines.

    Between columns is what divides the first line into most cells, and of several such the one that
    divides the second line likewise. Where it is not a comma, the first number with a decimal mark
    says which one the file has; without any, it is a comma between semicolons, where files with
    points have commas.
    """
    cells = _cells(lines)
    if cells.separator == _COMMA:
        return Dialect(cells, _POINT)
    default = _COMMA if cells.separator == ";" else _POINT
    return Dialect(cells, next(_decimal_marks(cells, lines), default))


def _cells(lines: Sequence[str]) -> Separated:
    def fit(cells: Separated) -> tuple[int, bool]:
        first, *second = (len(cells.split(line)) for line in lines[:2])
        return first, [first] == second

    best = max(map(Separated, _SEPARATORS), key=fit)
    return best if fit(best)[0] > 1 else Separated(_COMMA)


def _decimal_marks(cells: Separated, lines: Sequence[str]) -> Iterator[str]:
    """Yield the last point or comma of each number that has one."""
    for line in lines[1:]:
        for cell in cells.split(line) if _POINT in line or _COMMA in line else ():
            mark = max(_POINT, _COMMA, key=cell.rfind)
            if mark in cell and looks_numeric(cell):
                yield mark
