"""Which columns of a table are numbers, and which of these are of its frames, by their cells."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Sequence

import numpy as np

from mocapbench.datasets.formats.errors import FormatWarning
from mocapbench.datasets.formats.tables.columns import TableColumns, is_index
from mocapbench.datasets.formats.tables.labels import Label
from mocapbench.datasets.formats.text.numbers import is_missing, looks_numeric
from mocapbench.datasets.formats.text.rows import TextTable

__all__ = ["are_labelled", "are_numbers", "first_cells", "leave_other_times"]


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


def are_labelled(table: TextTable, labels: Sequence[Label]) -> list[bool]:
    """Return which columns are read as numbers: channels, and what counts frames or times."""
    first = table.row(table.rows[0]) if table.rows else []
    shown = dict(enumerate(cell.strip() for cell in first))
    return [
        looks_numeric(shown.get(k) or "0") if is_index(label.name) else not label.left_alone
        for k, label in enumerate(labels)
    ]


def leave_other_times(table: TextTable, columns: TableColumns) -> TableColumns:
    """Return the columns without those behind a repeated column of times that has other times.

    iSen writes times before each group of angles, and those of its sensors have other rates.
    """
    name = None if columns.time is None else table.names[columns.time]
    repeated = [k for k, other in enumerate(table.names) if other == name]
    if len(repeated) < 2:
        return columns
    times = table.numbers(repeated).T
    same = [((times[0] == other) | np.isnan(other)).all() for other in times]
    group_of = np.searchsorted(repeated, range(len(table.names)), side="right") - 1
    other = [k for k in columns.channels if not same[max(group_of[k], 0)]]
    if other:
        more = f" and {len(other) - 1} more" if len(other) > 1 else ""
        warnings.warn(
            f"{table.file}: left out, as their times are not those of the first column: "
            f"{table.names[other[0]]}{more}",
            FormatWarning,
            stacklevel=2,
        )
    channels = tuple(k for k in columns.channels if k not in other)
    return columns._replace(channels=channels)


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
