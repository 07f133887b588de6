"""A table of text: its head, its rows, and where each entry of a recording is in it."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.formats.building import recording_of
from mocapbench.datasets.formats.errors import FormatError, FormatWarning
from mocapbench.datasets.formats.missing_rows import count_missing_rows, warn_of_missing_rows
from mocapbench.datasets.formats.tables.clock_times import read_clocks
from mocapbench.datasets.formats.tables.columns import (
    TableColumns,
    sort_columns,
    split_unit,
    time_unit,
    warn_of_text,
)
from mocapbench.datasets.formats.tables.dialects import PLAIN
from mocapbench.datasets.formats.tables.frame_times import FrameTimes
from mocapbench.datasets.formats.tables.heads import Head, read_head
from mocapbench.datasets.formats.tables.kinds import are_labelled, are_numbers, leave_other_times
from mocapbench.datasets.formats.tables.labels import LENGTHS
from mocapbench.datasets.formats.tables.plan import RowTable, plan_rows
from mocapbench.datasets.formats.text.lines import read_lines
from mocapbench.datasets.formats.text.numbers import looks_numeric
from mocapbench.datasets.formats.text.rows import TextTable
from mocapbench.datasets.recording import FrameByChannel, Frames, Recording

__all__ = ["Sheet", "read_sheet"]

_MOST_INSERTED = 10
"""Rows that are inserted at most, for each that there is."""


Table_co = TypeVar("Table_co", bound=RowTable, covariant=True)


@dataclass(frozen=True)
class Sheet(Generic[Table_co]):
    """A table of R rows that holds N frames of D channels.

    Parameters
    ----------
    table : RowTable
        The rows; of a text, with the lines of the file down to the last one.
    below : sequence of str
        The lines below.
    head : Head
    columns : TableColumns
        What the columns are; C of them are channels.
    numbers : mapping of int to ndarray of shape (R,)
        The columns of numbers, NaN where a cell is missing.
    rows : ndarray of int of shape (N, G)
        Which row has which frame, and which of G groups of channels; −1 where none has.
    groups : tuple of G mappings of int to str
        The cells that all rows of a group share, by their columns.
    named_by : tuple of int
        The columns of them that tell groups apart.
    clocks : frozenset of int
        Columns of times as a clock shows them, whose numbers are seconds.
    """

    table: Table_co
    below: Sequence[str]
    head: Head
    columns: TableColumns
    numbers: Mapping[int, Frames]
    rows: NDArray[np.intp]
    groups: tuple[Mapping[int, str], ...]
    named_by: tuple[int, ...]
    clocks: frozenset[int] = frozenset()

    def recording(self, rate: float | None) -> Recording:
        """Return the recording, at a rate in place of the times of the table if one is given."""
        file, n_frames = self.table.file, len(self.rows)
        given = FrameTimes(
            file,
            self.index(self.columns.time),
            self._time_unit(),
            self.index(self.columns.frame),
            self.head.rate,
            self.table.names,
        )
        values = self._spread(self.columns.channels)
        for lost in self.lost_bodies():
            values[lost] = np.nan
        times = given.seconds(n_frames, rate)
        return recording_of(file, times, values, self._channels(), self._units())

    def _time_unit(self) -> str:
        """Return the unit that the name of the times states, or nothing; of clocks, seconds."""
        column = self.columns.time
        if column is None:
            return ""
        return "s" if column in self.clocks else time_unit(self.table.names[column])

    def lost_bodies(self) -> Iterator[tuple[NDArray[np.intp], ...]]:
        """Yield where a marker or body is at 0, 0, 0, if that means that it is missing.

        These are frames and channels as an index of (N, D), all channels of the body.
        """
        values = self._spread(self.columns.channels)
        bodies: dict[str, dict[str, int]] = {}
        units = self._units()
        for column, name in enumerate(self._channels() if self.head.dialect.zeros else ()):
            body, _, axis = name.rpartition(".")
            bodies.setdefault(body, {})[axis] = column
        for axes in bodies.values():
            # A force, for instance, may be 0, 0, 0.
            if {"x", "y", "z"} <= axes.keys() and units[axes["x"]] in LENGTHS:
                position = values[:, [axes["x"], axes["y"], axes["z"]]]
                yield np.ix_((position == 0.0).all(axis=1), [*axes.values()])

    def _channels(self) -> list[str]:
        names = [self._label(column)[0] for column in self.columns.channels]
        return [f"{self._prefix(group)}{name}" for group in self.groups for name in names]

    def _units(self) -> list[str]:
        units = [self._label(column)[1] for column in self.columns.channels]
        return units * len(self.groups)

    def likelihoods(self) -> FrameByChannel:
        """Return how likely the table says each entry is (N, D), NaN where it does not say it."""
        none = np.full(len(self.table.rows), np.nan)
        numbers = dict(self.numbers) | {-1: none}
        likely = [self.columns.likelihoods.get(column, -1) for column in self.columns.channels]
        return replace(self, numbers=numbers)._spread(likely)

    def warn_of_lacking(self, advice: str) -> None:
        """Say which rows are missing."""
        where = self._name_row
        warn_of_missing_rows(self.table.file, self.lacking(), where, self._named_index(), advice)

    def _name_row(self, frame: int) -> str:
        return self.table.name_row(int(self.rows[frame].max()))

    def lacking(self) -> NDArray[np.intp]:
        """Return how many frames are missing behind each but the last (N − 1,)."""
        return count_missing_rows(
            len(self.rows), self.index(self.columns.frame), self.index(self.columns.time)
        )

    def with_lacking(self) -> Sheet[Table_co]:
        """Return the sheet with the frames of which there is no row.

        Raises
        ------
        FormatError
            If they are so many that a time or a frame is probably wrong.
        """
        lacking = self.lacking()
        most = _MOST_INSERTED * len(self.rows)
        if lacking.sum() > most:
            row = int(self.rows[lacking.argmax() + 1].max())
            raise FormatError(
                self.table.file,
                f"{most} rows or fewer to insert",
                f"{lacking.sum()} by the steps of {self._named_index()}",
                "correct the frame or time",
                self.table.line_of(row),
            )
        behind = np.repeat(np.arange(1, len(self.rows)), lacking)
        return replace(self, rows=np.insert(self.rows, behind, -1, axis=0))

    def _named_index(self) -> str:
        by = self.columns.frame if self.columns.frame is not None else self.columns.time
        return repr(self.table.names[by]) if by is not None else "time"

    def index(self, column: int | None) -> Frames | None:
        """Return the frames or times of the frames (N,), between others where there is no row."""
        if column is None:
            return None
        rows = self.rows.max(axis=1)
        there = np.flatnonzero(rows >= 0)
        values: Frames = self.numbers[column][rows[there]]
        return np.interp(np.arange(len(rows)), there, values) if len(there) < len(rows) else values

    def _label(self, column: int) -> tuple[str, str]:
        label = self.head.labels[column]
        return split_unit(label.name) if self.head.dialect is PLAIN else (label.name, label.unit)

    def _prefix(self, group: Mapping[int, str]) -> str:
        cells = (
            f"{self.table.names[column].strip()}_{cell.strip()}" if looks_numeric(cell) else cell
            for column, cell in ((column, group[column]) for column in self.named_by)
        )
        return "".join(f"{cell.strip()}." for cell in cells if cell.strip())

    def _spread(self, columns: Sequence[int]) -> FrameByChannel:
        """Return the numbers of C columns as (N, G · C)."""
        rows = self.rows
        spread = np.full((*rows.shape, len(columns)), np.nan)
        for place, column in enumerate(columns):
            spread[..., place][rows >= 0] = self.numbers[column][rows[rows >= 0]]
        return spread.reshape(len(rows), rows.shape[1] * len(columns))


def read_sheet(path: Path) -> Sheet[TextTable]:
    """Return the table of a file.

    Raises
    ------
    FormatError
        If it is none, or is damaged. Which program's table it looks like is said.
    """
    lines = read_lines(path)
    head = read_head(path.name, lines)
    try:
        return _read_rows(path.name, lines, head)
    except FormatError as error:
        if head.dialect is not PLAIN:
            error.expected += f", in a table of {head.dialect.program}"
        raise


def _read_rows(file: str, lines: Sequence[str], head: Head) -> Sheet[TextTable]:
    table = _table_below(file, lines, head)
    columns, clocks = _tell_columns(table, head)
    read = sorted(
        {*columns.channels, *columns.likelihoods.values(), *columns.telling_frames} - {*clocks}
    )
    values = table.numbers(read)
    numbers = {column: values[:, place] for place, column in enumerate(read)} | clocks
    (rows, groups, named_by), columns = plan_rows(table, columns, numbers)
    keys = {column for group in groups for column in group}
    if head.dialect is PLAIN:
        warn_of_text(file, [table.names[k] for k in columns.left_out if k not in keys])
    _compare_counts(file, head, len(values))
    below = lines[head.stop :]
    return Sheet(table, below, head, columns, numbers, rows, groups, named_by, frozenset(clocks))


def _table_below(file: str, lines: Sequence[str], head: Head) -> TextTable:
    """Return the rows below a head."""
    names = [label.name for label in head.labels]
    _check_named(file, head, names)
    width = len(names)
    while width > 1 and not names[width - 1] and head.dialect is not PLAIN:
        width -= 1  # a separator may end the line
    cells, decimal = head.notation
    return TextTable(file, lines[: head.stop], head.start, cells, width, width, decimal, names)


def _tell_columns(table: TextTable, head: Head) -> tuple[TableColumns, dict[int, Frames]]:
    """Return what the columns are, and the seconds of the one that has the times of a clock."""
    known = head.dialect is not PLAIN
    is_number = are_labelled(table, head.labels) if known else are_numbers(table)
    left_alone = frozenset(k for k, label in enumerate(head.labels) if label.left_alone)
    clocks = read_clocks(table, is_number)
    is_number = [number or k in clocks for k, number in enumerate(is_number)]
    columns = sort_columns(table.names, is_number, left_alone)
    _check_filled(table.file, head, columns, len(table.rows))
    return leave_other_times(table, columns), clocks


def _check_filled(file: str, head: Head, columns: TableColumns, n_rows: int) -> None:
    """Refuse a head with nothing below, or with columns of other things alone."""
    if head.dialect is not PLAIN and not (columns.channels and n_rows):
        got = f"{n_rows} rows of {len(columns.channels)} positions or angles"
        advice = "export the recording again, with positions or angles"
        raise FormatError(file, "rows of numbers below the head", got, advice)


def _check_named(file: str, head: Head, names: Sequence[str]) -> None:
    """Refuse columns called X, Y, Z again and again, which lost the lines with the markers."""
    axes = sum(name.strip().upper() in {"X", "Y", "Z"} for name in names)
    if head.dialect is PLAIN and axes > 3 and len({*names}) < len(names):
        raise FormatError(
            file,
            "a line with names of markers above the axes X, Y, Z",
            "the axes alone",
            "this looks like a table of OptiTrack Motive or Vicon Nexus whose head was cut: export "
            "it again, with the whole head",
            line=1,
        )


def _compare_counts(file: str, head: Head, n_rows: int) -> None:
    if head.n_rows is not None and head.n_rows != n_rows:
        warnings.warn(
            f"{file}: expected {head.n_rows:g} rows, as its head says, got {n_rows}: the file may "
            "be cut short; all that are there are read",
            FormatWarning,
            stacklevel=2,
        )
