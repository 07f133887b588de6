"""Which columns of a table are numbers, by their cells."""

from __future__ import annotations

from collections.abc import Iterable

from mocapbench.datasets.formats.text.numbers import is_missing, looks_numeric
from mocapbench.datasets.formats.text.rows import TextTable

__all__ = ["are_numbers", "first_cells"]


def are_numbers(table: TextTable) -> list[bool]:
    """Return whether each column has numbers, or nothing: if its first cell does not tell, all do.

    Of different texts and numbers, the half or more are numbers; so a mark of missing values that
    is repeated counts once.
    """
    first = first_cells(table)
    unsure = [column for column, cell in first.items() if not looks_numeric(cell)]
    different: dict[int, set[str]] = {column: set() for column in unsure}
    for index in table.rows if unsure else ():
        row = table.row(index)
        for column in unsure:
            different[column].add(row[column])
    text = {column for column in unsure if not _is_mostly_numeric(different[column])}
    return [column not in text for column in range(table.width)]


def first_cells(table: TextTable) -> dict[int, str]:
    """Return the first cell of each column that is not missing, if there is one."""
    first: dict[int, str] = {}
    for index in table.rows:
        row = enumerate(table.row(index)[: table.width])
        first |= {k: cell for k, cell in row if k not in first and not is_missing(cell)}
        if len(first) == table.width:
            break
    return first


def _is_mostly_numeric(cells: Iterable[str]) -> bool:
    numeric = [looks_numeric(cell) for cell in cells if not is_missing(cell)]
    return 2 * sum(numeric) >= len(numeric)
