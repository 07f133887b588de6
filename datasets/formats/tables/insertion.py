"""A table of text with some cells changed, and rows inserted where it has none."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence

import numpy as np

from mocapbench.datasets.formats.tables.clock_times import is_clock, set_clock
from mocapbench.datasets.formats.tables.sheet import Sheet
from mocapbench.datasets.formats.text.numbers import format_number
from mocapbench.datasets.recording import FrameByChannel, Frames, Mask

__all__ = ["lines_with"]


def lines_with(sheet: Sheet, values: FrameByChannel, new: Mask) -> list[str]:
    """Return the lines of a table's file with the ``new`` entries (N, D) of some values.

    A marker or body that the file has at 0, 0, 0, as missing, is filled as a whole or not at all.
    """
    new = _whole_bodies(sheet, new)
    lines = _change_rows(sheet, values, new)
    inserted = _insert_rows(sheet, values, new)
    for row, index in enumerate(sheet.table.rows):
        lines[index] = _join_lines(lines[index], inserted.get(row, ()), like=lines[0])
    return [*lines, *sheet.below]


def _whole_bodies(sheet: Sheet, new: Mask) -> Mask:
    """Return the new entries but those of bodies at 0, 0, 0 of which something would stay 0."""
    whole = new.copy()
    for lost in sheet.lost_bodies():
        whole[lost] = new[lost].all(axis=1, keepdims=True)
    return whole


def _change_rows(sheet: Sheet, values: FrameByChannel, new: Mask) -> list[str]:
    """Return the lines with the new cells of rows that there are."""
    rows, columns = sheet.rows, sheet.columns.channels
    shape = (*rows.shape, len(columns))
    there = rows >= 0
    cells = np.zeros((len(sheet.table.rows), len(columns)))
    changed = np.zeros(cells.shape, dtype=bool)
    cells[rows[there]] = values.reshape(shape)[there]
    changed[rows[there]] = new.reshape(shape)[there]
    return sheet.table.with_numbers(columns, cells, changed)


def _insert_rows(sheet: Sheet, values: FrameByChannel, new: Mask) -> dict[int, list[str]]:
    """Return lines to insert, by the row behind which they belong."""
    rows, columns = sheet.rows, sheet.columns.channels
    shape = (*rows.shape, len(columns))
    values, new = values.reshape(shape), new.reshape(shape)
    places = np.where(rows.ravel() >= 0, np.arange(rows.size), 0)
    last = rows.ravel()[np.maximum.accumulate(places)].clip(0)  # the row of the entries before
    inserted = defaultdict(list)
    for frame, group in np.argwhere(rows < 0).tolist():
        before = int(last[frame * rows.shape[1] + group])
        if new[frame, group].any() or (rows[frame] < 0).all():
            cells: dict[int, str] = {
                column: format_number(values[frame, group, k], sheet.table.decimal)
                for k, column in enumerate(columns)
                if new[frame, group, k]
            }
            line = _make_row(sheet, frame, before, {**cells, **sheet.groups[group]})
            inserted[before].append(line)
    return dict(inserted)


def _make_row(sheet: Sheet, frame: int, before: int, cells: Mapping[int, str]) -> str:
    """Return a line like that of the row before, with other cells and no others."""
    table = sheet.table
    index = (sheet.columns.frame, sheet.columns.time)
    told = {k: _index_cell(sheet, k, frame, before) for k in index if k is not None}
    missing = "" if table.cells.separator else "nan"
    empty = dict.fromkeys(range(table.width), missing)
    return table.cells.replace_cells(table.lines[table.rows[before]], empty | told | dict(cells))


def _index_cell(sheet: Sheet, column: int, frame: int, before: int) -> str:
    """Return the cell with the frame or time of a frame, written as those of other rows."""
    of_frame = sheet.rows[frame].max()
    if of_frame >= 0:
        return sheet.table.row(sheet.table.rows[int(of_frame)])[column]
    like = sheet.table.row(sheet.table.rows[before])[column].strip()
    values: Frames = sheet.index(column)  # type: ignore[assignment]
    if is_clock(like):
        return set_clock(like, float(values[frame]))
    digits = len(like.partition(sheet.table.decimal)[2])
    return f"{values[frame]:.{digits}f}".replace(".", sheet.table.decimal)


def _join_lines(line: str, behind: Sequence[str], like: str) -> str:
    """Return a line and those behind it, which end as another does but where the file ends."""
    ended = line != line.rstrip("\r\n")
    return ("" if ended else like[len(like.rstrip("\r\n")) :]).join([line, *behind])
