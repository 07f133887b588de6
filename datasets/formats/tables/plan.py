"""Which row of a table has which frame: one row a frame, or one for each marker of each frame."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.tables.columns import TableColumns
from mocapbench.datasets.formats.text.numbers import looks_numeric
from mocapbench.datasets.recording import Frames

__all__ = ["RowPlan", "RowTable", "is_key", "plan_long", "plan_rows", "plan_wide"]

_KEY = re.compile(
    r"""(?:(?:marker|keypoint|key[ _]point|landmark|joint|node|point|body[ _]?part|part|segment|
    bone|track|person|individual|instance|animal|subject|name|label|object|hand|model|
    side|limb|sensor|imu)s?
    (?:[ _]?(?:id|idx|index|name|no|nr|num|number|label))?|id)""",
    re.VERBOSE | re.IGNORECASE,
)
_SPARSE = 8
"""Rows that a table could have, at most, for each that it has."""
_FEW = 100_000


RowPlan = tuple[NDArray[np.intp], tuple[Mapping[int, str], ...], tuple[int, ...]]
"""The row of each frame and group of channels (N, G), −1 where there is none; of each group, the
cells that all its rows share, by their columns; and the columns of them that tell groups apart."""


class RowTable(Protocol):
    """A table with a row for each frame, or for each marker of each frame."""

    @property
    def file(self) -> str:
        """Name of the file in errors."""

    @property
    def names(self) -> Sequence[str]:
        """Of the columns."""

    @property
    def rows(self) -> Sequence[int]:
        """As many as there are rows."""

    def texts(self, columns: Sequence[int]) -> dict[int, list[str]]:
        """Return the cells of some columns."""

    def name_row(self, row: int) -> str:
        """Return what messages call a row."""

    def line_of(self, row: int) -> int | None:
        """Return the line of a row in a text, counted from 1."""


def is_key(name: str) -> bool:
    """Return whether a column of this name says of which marker, or whom, a row is."""
    return _KEY.fullmatch(name.strip()) is not None


def plan_rows(
    table: RowTable, columns: TableColumns, numbers: Mapping[int, Frames]
) -> tuple[RowPlan, TableColumns]:
    """Return where the frames are, and the columns but those that tell rows of a frame apart."""
    keys = [k for k in columns.channels if is_key(table.names[k])] + list(columns.left_out)
    index = [numbers[column] for column in columns.telling_frames]
    if not index:
        _check_keys(table, keys)
    rising = columns.time is not None and (np.diff(index[0]) > 0).all()
    # Times repeat also where they are rounded, but not if a column names markers.
    rounded = columns.frame is None and not any(is_key(table.names[k]) for k in keys)
    if not index or rising or rounded or not _repeats(index[-1]):
        apart = {k for k in keys if k in numbers and _is_constant(numbers[k])}
        channels = tuple(column for column in columns.channels if column not in apart)
        return plan_wide(len(table.rows)), columns._replace(channels=channels)
    plan = plan_long(table, index[-1], table.texts(keys))
    shared = {column for group in plan[1] for column in group}
    channels = tuple(column for column in columns.channels if column not in shared)
    return plan, columns._replace(channels=channels)


def plan_wide(n_rows: int) -> RowPlan:
    """Return the plan of a table with one row a frame."""
    return np.arange(n_rows)[:, np.newaxis], ({},), ()


def plan_long(table: RowTable, index: Frames, keys: Mapping[int, Sequence[str]]) -> RowPlan:
    """Return the plan of a table with several rows a frame, by the columns that tell them apart.

    Parameters
    ----------
    table : RowTable
    index : ndarray of shape (R,)
        The frame or time of each row.
    keys : mapping of int to sequence of R str
        Cells of the columns that may tell the rows of a frame apart.

    Raises
    ------
    FormatError
        If no column does.
    """
    if not np.isfinite(index).all():
        row = int(np.flatnonzero(~np.isfinite(index))[0])
        expected, got = "a frame or time in every row", f"none in {table.name_row(row)}"
        raise FormatError(table.file, expected, got, "add it", table.line_of(row))
    frames, frame_of = np.unique(index, return_inverse=True)
    for columns in _candidates(keys):
        cells = list(zip(*(keys[column] for column in columns), strict=True))
        codes = {cell: code for code, cell in enumerate(dict.fromkeys(cells))}
        group_of = np.array([codes[cell] for cell in cells])
        if len(frames) * len(codes) > max(_SPARSE * len(index), _FEW):
            continue
        rows = np.full((len(frames), len(codes)), -1)
        rows[frame_of, group_of] = np.arange(len(index))
        if (rows >= 0).sum() == len(index):
            return rows, _shared_cells(keys, group_of), columns
    raise _ambiguous(table, index, frame_of, keys)


def _shared_cells(
    keys: Mapping[int, Sequence[str]], group_of: NDArray[np.intp]
) -> tuple[Mapping[int, str], ...]:
    """Return the cells that all rows of each group share, of the columns that vary within none."""
    _, first_rows = np.unique(group_of, return_index=True)
    shared = [
        column
        for column, cells in keys.items()
        if len({*zip(group_of.tolist(), cells, strict=True)}) == len(first_rows)
    ]
    return tuple({column: keys[column][row] for column in shared} for row in first_rows.tolist())


def _candidates(keys: Mapping[int, Sequence[str]]) -> Iterable[tuple[int, ...]]:
    """Yield one column, two, and so on, those with fewest different cells first.

    Of equals, those of text come first: names say more than numbers.
    """
    columns = sorted(keys, key=lambda one: (len({*keys[one]}), looks_numeric(keys[one][0])))
    for size in range(1, min(len(columns), 4) + 1):
        yield from combinations(columns, size)


def _ambiguous(
    table: RowTable,
    index: Frames,
    frame_of: NDArray[np.intp],
    keys: Mapping[int, Sequence[str]],
) -> FormatError:
    repeated = np.bincount(frame_of)[frame_of] > 1
    first = int(np.flatnonzero(repeated)[0])
    again = int(np.flatnonzero(frame_of == frame_of[first])[1])
    told = "that columns of text tell apart" if keys else "or a column that tells rows apart"
    return FormatError(
        table.file,
        f"one row for each frame, {told}",
        f"{index[first]:g} again, after {table.name_row(first)}",
        "split a table of several recordings or people, or name the marker of each row in a column "
        "'keypoint'",
        table.line_of(again),
    )


def _check_keys(table: RowTable, keys: Iterable[int]) -> None:
    """Refuse rows of several markers where nothing says of which frames they are."""
    for column in (key for key in keys if is_key(table.names[key])):
        cells = table.texts([column])[column]
        if 1 < len({*cells}) < len(cells):
            raise FormatError(
                table.file,
                "a column 'frame' in a table with a row for each marker of each frame",
                f"none beside {table.names[column]!r}",
                "add it, or write one row a frame",
                line=1,
            )


def _repeats(index: Frames) -> bool:
    known = index[~np.isnan(index)]
    return len(np.unique(known)) < len(known)


def _is_constant(values: Frames) -> bool:
    """Return whether no two values differ, as where all rows are of one marker or person."""
    return len(np.unique(values[~np.isnan(values)])) < 2
