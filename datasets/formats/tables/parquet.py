"""Parquet: a column of times and one column a channel, or a row for each marker of each frame."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from sys import intern
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.isolation.calls import IsolatedCallError, call_isolated
from mocapbench.datasets.formats.tables.clock_times import is_clock, read_clocks, set_clock
from mocapbench.datasets.formats.tables.columns import is_time, sort_columns, warn_of_text
from mocapbench.datasets.formats.tables.dialects import PLAIN
from mocapbench.datasets.formats.tables.heads import Head
from mocapbench.datasets.formats.tables.insertion import arrange_entries, list_added_rows
from mocapbench.datasets.formats.tables.labels import Label
from mocapbench.datasets.formats.tables.plan import plan_rows
from mocapbench.datasets.formats.tables.sheet import Sheet
from mocapbench.datasets.formats.tables.table_format import TableFormat
from mocapbench.datasets.formats.text.cells import Words
from mocapbench.datasets.recording import FrameByChannel, Frames, Mask

__all__ = ["ParquetFormat"]

_COLUMNS = "mocapbench.datasets.formats.tables.parquet_columns"
_SECONDS, _SECONDS_PER_BYTE = 10.0, 1e-6
_MEMORY = 2**30  # of a small file


class ParquetFormat(TableFormat):
    """Parquet (.parquet): a column of times, one column a channel.

    Columns are named as in a CSV file (`CSVFormat`), and rows may have a marker each as there.
    Nulls and NaN are hidden. Filled values keep the type of their column, but a column of integers
    becomes one of 64-bit floats. Columns of text, dates and so on, and what the file says about
    itself, are kept; they are null in rows that are added.

    Parameters
    ----------
    inserts : bool
        Whether rows that are missing, as times or frames show, are read as hidden frames, and are
        written.
    """

    suffixes: ClassVar[tuple[str, ...]] = (".parquet",)
    needs: ClassVar[tuple[str, str] | None] = ("pyarrow", "parquet")
    memory_per_byte: ClassVar[float] = 24.0

    def sheet(self, path: Path) -> Sheet[ParquetTable]:
        """Return the table of a file, without rows that are missing."""
        read = _read_columns(path)
        table, values = ParquetTable(path.name, read), read["values"]
        named = np.array([is_time(name) for name in table.names], dtype=bool)
        typed = read["is_time"] & named & ~(read["is_number"] & named).any()
        texts = read_clocks(table, (read["is_number"] | typed).tolist())
        clocks = {*np.flatnonzero(typed).tolist(), *texts}
        is_number = [bool(read["is_number"][k]) or k in clocks for k in range(len(table.names))]
        numbers = dict(enumerate(values.T)) | texts
        columns = sort_columns(table.names, is_number)
        (rows, groups, named_by), columns = plan_rows(table, columns, numbers)
        keys = {column for group in groups for column in group}
        warn_of_text(path.name, [table.names[k] for k in columns.left_out if k not in keys])
        head = Head(PLAIN, (Words(), "."), 0, len(values), [Label(name) for name in table.names])
        return Sheet(table, (), head, columns, numbers, rows, groups, named_by, frozenset(clocks))

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's columns with the new entries, and the rows that are added."""
        sheet = self.complete(self.sheet(like))
        added = sorted(list_added_rows(sheet, new), key=lambda row: row[2])
        behind = [before + 1 for _, _, before in added]
        cells, changed = arrange_entries(sheet, values, new)
        of_frames = np.where(new, values, np.nan).reshape(*sheet.rows.shape, -1)
        of_added = [of_frames[frame, group] for frame, group, _ in added]
        of_rows = np.where(changed, cells, np.nan)
        entries = np.insert(of_rows, behind, of_added, axis=0) if added else of_rows
        rows = np.insert(np.arange(len(cells)), behind, -1)
        written = dict(zip(sheet.columns.channels, entries.T, strict=True))
        shared = dict(_share_cells(sheet, added)) if added else {}
        import_module(_COLUMNS).write_columns(path, like, rows, written, shared)


class ParquetTable:
    """The columns of a file: its numbers, and its texts, which are decoded where they are needed.

    Parameters
    ----------
    file : str
        Name of the file in errors.
    read : mapping of str to ndarray
        As `read_columns` returns it.
    """

    def __init__(self, file: str, read: Mapping[str, NDArray[Any]]) -> None:
        self.file = file
        self.names: list[str] = read["names"].tolist()
        self.numbers: dict[int, Array] = {
            k: read["values"][:, k] for k in np.flatnonzero(read["is_number"]).tolist()
        }
        self.rows: range = range(len(read["values"]))
        self._read = read

    def texts(self, columns: Sequence[int]) -> dict[int, list[str]]:
        """Return the cells of some columns, empty ones of other types."""
        return {column: self._decode(column) for column in columns}

    def name_row(self, row: int) -> str:
        """Return what messages call a row."""
        return f"row {row + 1}"

    def line_of(self, row: int) -> int | None:
        """Return None, as no row is a line of a text."""
        del row
        return None

    def _decode(self, column: int) -> list[str]:
        if column in self.numbers:
            return [_show_number(value) for value in self.numbers[column].tolist()]
        if f"ends {column}" not in self._read:
            return [""] * len(self.rows)
        data, ends = self._read[f"text {column}"].tobytes(), self._read[f"ends {column}"].tolist()
        bounds = zip([0, *ends], ends, strict=False)
        return [intern(data[start:stop].decode(errors="replace")) for start, stop in bounds]


def _show_number(value: float) -> str:
    return f"{value:.0f}" if value.is_integer() else "" if np.isnan(value) else repr(value)


def _share_cells(
    sheet: Sheet[ParquetTable], added: Sequence[tuple[int, int, int]]
) -> Iterator[tuple[int, Frames | list[str]]]:
    """Yield columns with the cells of added rows: frames, times, and what their group shares."""
    frames, groups, before = np.array(added, dtype=np.intp).reshape(-1, 3).T
    for column in sheet.columns.telling_frames:
        index: Frames = sheet.index(column)  # type: ignore[assignment]
        texts = sheet.table.texts([column])[column]
        if is_clock(texts[0]):
            like = [texts[row] for row in before.tolist()]
            yield column, list(map(set_clock, like, index[frames].tolist()))
        else:
            yield column, index[frames]
    for column in sheet.groups[0]:
        cells = [sheet.groups[group][column] for group in groups.tolist()]
        if column in sheet.table.numbers:
            yield column, np.array([float(cell or "nan") for cell in cells])
        elif any(cells):
            yield column, cells


def _read_columns(path: Path) -> Mapping[str, NDArray[Any]]:
    """Return the columns of a file, read in a process of its own."""
    size = path.stat().st_size
    memory = ParquetFormat.memory_per_byte * size + _MEMORY
    timeout = _SECONDS + _SECONDS_PER_BYTE * size
    try:
        name = str(path.absolute())  # the reading process may be in another folder
        return call_isolated(f"{_COLUMNS}:read_columns", name, timeout=timeout, memory=memory)
    except IsolatedCallError as error:
        advice = "export the recording again as Parquet"
        raise FormatError(path.name, "a Parquet file", str(error), advice) from error
