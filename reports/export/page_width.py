"""Tables as wide as a page: turned on their side, or in parts, where the columns are too many.

Widths are in letters. LaTeX's class ``article`` has room for some 75 of its size ``small`` in a
line, and the space between two columns is that of three.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import count
from textwrap import wrap

import numpy as np

from mocapbench.reports.tables.base import Cell, Table

__all__ = ["fit_page", "wrap_head"]

_LINE = 75
_GAP = 3
_NARROWEST_HEAD = 10


def fit_page(table: Table) -> list[Table]:
    """Return a table as one that fits a page, or in parts that do.

    Rows and columns change places where it fits a page only so, or has a single row.
    """
    turned = _transpose(table)
    lies_better = len(table.rows) == 1 or (not _fits_page(table) and _fits_page(turned))
    return _split(turned if lies_better else table)


def wrap_head(head: Cell, cells: Sequence[Cell]) -> list[str]:
    """Return the lines of the head of a column, about as wide as its cells."""
    width = max(_NARROWEST_HEAD, *map(_count_letters, cells))
    lines = wrap(head.text, width, break_long_words=False, break_on_hyphens=False)
    return [*lines, *([head.note] if head.note else [])]


def _transpose(table: Table) -> Table:
    heads, *rows = zip(table.columns, *table.rows, strict=True)
    return replace(table, columns=(replace(heads[0], text=""), *heads[1:]), rows=tuple(rows))


def _split(table: Table) -> list[Table]:
    """Return the columns of a table in as few parts as fit a page, all about as wide."""
    places = np.arange(1, len(table.columns))
    for n in range(1, len(table.columns)):
        parts = [_pick_columns(table, part.tolist()) for part in np.array_split(places, n)]
        if all(map(_fits_page, parts)):
            break
    return [table] if len(parts) == 1 else [*map(_name_part, parts, count(1))]


def _name_part(table: Table, n: int) -> Table:
    return replace(table, id=f"{table.id}-{n}", caption=f"{table.caption} Part {n}.")


def _pick_columns(table: Table, places: Sequence[int]) -> Table:
    kept = (0, *places)
    rows = tuple(tuple(row[place] for place in kept) for row in table.rows)
    return replace(table, columns=tuple(table.columns[place] for place in kept), rows=rows)


def _fits_page(table: Table) -> bool:
    first, *others = zip(table.columns, *table.rows, strict=True)
    widths = [max(map(_count_letters, first)), *(_column_width(*column) for column in others)]
    return sum(widths) + _GAP * len(others) <= _LINE


def _column_width(head: Cell, *cells: Cell) -> int:
    return max(*map(len, wrap_head(head, cells)), *map(_count_letters, cells))


def _count_letters(cell: Cell) -> int:
    spread = f" ± {cell.spread}" if cell.spread else ""
    return len(cell.text + spread)  # a raised mark goes into the space between columns
