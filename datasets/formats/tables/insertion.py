"""Tables with some entries changed, and rows added where they have none."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from mocapbench.datasets.formats.tables.clock_times import is_clock, set_clock
from mocapbench.datasets.formats.tables.plan import RowTable
from mocapbench.datasets.formats.tables.sheet import Sheet
from mocapbench.datasets.formats.text.numbers import format_number
from mocapbench.datasets.formats.text.rows import TextTable
from mocapbench.datasets.recording import FrameByChannel, Frames, Mask

__all__ = ["arrange_entries", "lines_with", "list_added_rows"]


def lines_with(sheet: Sheet[TextTable], values: FrameByChannel, new: Mask) -> list[str]:
    """Return the lines of a table's file with the ``new`` entries (N, D) of some values.

    A marker or body that the file has at 0, 0, 0, as missing, is filled as a whole or not at all.
    """
    new = _whole_bodies(sheet, new)
    cells, changed = arrange_entries(sheet, values, new)
    lines = sheet.table.with_numbers(sheet.columns.channels, cells, changed)
    inserted = _insert_rows(sheet, values, new)
    for row, index in enumerate(sheet.table.rows):
        lines[index] = _join_lines(lines[index], inserted.get(row, ()), like=lines[0])
    return [*lines, *sheet.below]


def _whole_bodies(sheet: Sheet[TextTable], new: Mask) -> Mask:
    """Return the new entries but those of bodies at 0, 0, 0 of which something would stay 0."""
    whole = new.copy()
    for lost in sheet.lost_bodies():
        whole[lost] = new[lost].all(axis=1, keepdims=True)
    return whole


def arrange_entries(
    sheet: Sheet[RowTable], values: FrameByChannel, new: Mask
) -> tuple[FrameByChannel, Mask]:
    """Return numbers for the R rows of a table, and which of them are new, (R, C) each."""
    rows, columns = sheet.rows, sheet.columns.channels
    shape = (*rows.shape, len(columns))
    there = rows >= 0
    cells = np.zeros((len(sheet.table.rows), len(columns)))
    changed = np.zeros(cells.shape, dtype=bool)
    cells[rows[there]] = values.reshape(shape)[there]
    changed[rows[there]] = new.reshape(shape)[there]
    return cells, changed


def list_added_rows(sheet: Sheet[RowTable], new: Mask) -> Iterator[tuple[int, int, int]]:
    """Yield frame and group of each row to add, and the row behind which it belongs.

    These are rows with new entries, and all those of frames that have none.
    """
    rows = sheet.rows
    filled = np.asarray(new.reshape(*rows.shape, -1).any(axis=2))
    places = np.where(rows.ravel() >= 0, np.arange(rows.size), 0)
    last = rows.ravel()[np.maximum.accumulate(places)].clip(0)  # the row of the entries before
    for frame, group in np.argwhere(rows < 0).tolist():
        if filled[frame, group] or (rows[frame] < 0).all():
            yield frame, group, int(last[frame * rows.shape[1] + group])


def _insert_rows(
    sheet: Sheet[TextTable], values: FrameByChannel, new: Mask
) -> dict[int, list[str]]:
    """Return lines to insert, by the row behind which they belong."""
    columns = sheet.columns.channels
    shape = (*sheet.rows.shape, len(columns))
    inserted = defaultdict(list)
    for frame, group, before in list_added_rows(sheet, new):
        row, is_new = values.reshape(shape)[frame, group], new.reshape(shape)[frame, group]
        cells: dict[int, str] = {
            column: format_number(row[k], sheet.table.decimal)
            for k, column in enumerate(columns)
            if is_new[k]
        }
        line = _make_row(sheet, frame, before, {**cells, **sheet.groups[group]})
        inserted[before].append(line)
    return dict(inserted)


def _make_row(sheet: Sheet[TextTable], frame: int, before: int, cells: Mapping[int, str]) -> str:
    """Return a line like that of the row before, with other cells and no others."""
    table = sheet.table
    index = (sheet.columns.frame, sheet.columns.time)
    told = {k: _index_cell(sheet, k, frame, before) for k in index if k is not None}
    missing = "" if table.cells.separator else "nan"
    empty = dict.fromkeys(range(table.width), missing)
    return table.cells.replace_cells(table.lines[table.rows[before]], empty | told | dict(cells))


def _index_cell(sheet: Sheet[TextTable], column: int, frame: int, before: int) -> str:
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
