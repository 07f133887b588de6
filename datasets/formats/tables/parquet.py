"""Parquet: a column of times and one column a channel."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

import numpy as np

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.building import recording_of
from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.isolation.calls import IsolatedCallError, call_isolated
from mocapbench.datasets.formats.missing_rows import count_missing_rows, warn_of_missing_rows
from mocapbench.datasets.formats.tables.columns import (
    TableColumns,
    is_time,
    sort_columns,
    split_unit,
    time_unit,
    warn_of_text,
)
from mocapbench.datasets.formats.tables.frame_times import FrameTimes
from mocapbench.datasets.formats.tables.plan import is_key
from mocapbench.datasets.recording import FrameByChannel, Frames, Mask, Recording

__all__ = ["ParquetFormat"]

_COLUMNS = "mocapbench.datasets.formats.tables.parquet_columns"
_SECONDS, _SECONDS_PER_BYTE = 10.0, 1e-6
_MEMORY = 2**30  # of a small file


class ParquetFormat(Format):
    """Parquet (.parquet): a column of times, one column a channel.

    Columns are named as in a CSV file (`CSVFormat`). Nulls and NaN are hidden. Filled values keep
    the type of their column, but a column of integers becomes one of 64-bit floats. Columns of
    text, dates and so on, and what the file says about itself, are kept.
    """

    suffixes = (".parquet",)
    needs = ("pyarrow", "parquet")
    memory_per_byte = 24.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        names, columns, values = _read_table(path)
        times, frames = (None if k is None else values[:, k] for k in (columns.time, columns.frame))
        _check_one_row_a_frame(path.name, names, times, frames)
        missing, advice = (
            count_missing_rows(len(values), frames, times),
            "they stay so, as in all Parquet files",
        )
        by = "times" if frames is None else "frames"
        warn_of_missing_rows(path.name, missing, lambda row: f"row {row + 1}", by, advice)
        unit = "" if columns.time is None else time_unit(names[columns.time])
        given = FrameTimes(path.name, times, unit, frames, None, names)
        warn_of_text(path.name, [names[column] for column in columns.left_out])
        named = [split_unit(names[column]) for column in columns.channels]
        return recording_of(
            path.name,
            given.seconds(len(values), rate),
            values[:, list(columns.channels)],
            [name for name, _ in named],
            [unit for _, unit in named],
        )

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's columns with the new entries."""
        _, columns, _ = _read_table(like)
        import_module(_COLUMNS).write_columns(path, columns.channels, values, new, like)


def _read_table(path: Path) -> tuple[list[str], TableColumns, FrameByChannel]:
    """Return the names of all columns, what these are, and their values (N, columns)."""
    size = path.stat().st_size
    memory = ParquetFormat.memory_per_byte * size + _MEMORY
    timeout = _SECONDS + _SECONDS_PER_BYTE * size
    try:
        name = str(path.absolute())  # the reading process may be in another folder
        read = call_isolated(f"{_COLUMNS}:read_columns", name, timeout=timeout, memory=memory)
    except IsolatedCallError as error:
        advice = "export the recording again as Parquet"
        raise FormatError(path.name, "a Parquet file", str(error), advice) from error
    names = read["names"].tolist()
    named = np.array([is_time(name) for name in names], dtype=bool)
    clocks = read["is_time"] & named & ~(read["is_number"] & named).any()
    is_number = (read["is_number"] | clocks).tolist()
    return names, sort_columns(names, is_number), read["values"]


def _check_one_row_a_frame(
    file: str, names: Sequence[str], times: Frames | None, frames: Frames | None
) -> None:
    """Refuse a table with a row for each marker of each frame, of which rows are no frames.

    Frames repeat in it, or times do and a column says of which marker a row is.
    """
    index = times if frames is None and any(map(is_key, names)) else frames
    if index is None or (times is not None and (np.diff(times) > 0).all()):
        return
    values, counts = np.unique(index, return_counts=True)
    for value in values[counts > 1][:1]:
        advice = "write one row a frame, with a column for each coordinate, or export it as CSV"
        raise FormatError(file, "one row a frame", f"several of frame {value:g}", advice)
