"""The columns of Parquet files by pyarrow; reading is for a process of its own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq
from numpy.typing import NDArray

from mocapbench.datasets.recording import FrameByChannel, Frames, Mask

__all__ = ["read_columns", "write_columns"]

_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}


def read_columns(path: str) -> Mapping[str, NDArray[Any]]:
    """Return the columns of a file.

    Returns
    -------
    dict of str to ndarray
        ``names`` (C,), ``is_number`` (C,), ``is_time`` (C,) and ``values`` (N, C), those of times
        in seconds, NaN where there is none.
    """
    table = _read_table(Path(path))
    is_number = [_is_number(field.type) for field in table.schema]
    is_time = [_seconds_of(field.type) is not None for field in table.schema]
    values = np.full((len(table), len(is_number)), np.nan)
    for index in np.flatnonzero(np.logical_or(is_number, is_time)).tolist():
        column = table.column(index)
        unit = _seconds_of(column.type)
        values[:, index] = _floats(column) if unit is None else _seconds(column, unit)
    return {
        "names": np.array(table.column_names, dtype=np.str_),
        "is_number": np.array(is_number, dtype=bool),
        "is_time": np.array(is_time, dtype=bool),
        "values": values,
    }


def write_columns(
    path: Path, columns: Sequence[int], values: FrameByChannel, new: Mask, like: Path
) -> None:
    """Write a copy of a file with the ``new`` entries (N, columns) of some columns replaced."""
    table = _read_table(like)
    for place in np.flatnonzero(new.any(axis=0)).tolist():
        index = columns[place]
        old, rows = table.column(index), new[:, place]
        missing = np.asarray(old.is_null()) & ~rows
        kind = old.type if pa.types.is_floating(old.type) else pa.float64()
        filled = np.where(rows, values[:, place], _floats(old)).astype(kind.to_pandas_dtype())
        field = table.schema.field(index).with_type(kind)
        table = table.set_column(index, field, pa.array(filled, kind, mask=missing))
    with path.open("wb") as stream:
        pq.write_table(table, stream)


def _read_table(path: Path) -> pa.Table:
    # From a stream: pyarrow takes no name that is not UTF-8, and a folder "a=1" for a column.
    with path.open("rb") as stream:
        return pq.read_table(stream, use_threads=False)


def _is_number(kind: pa.DataType) -> bool:
    return bool(pa.types.is_floating(kind) or pa.types.is_integer(kind))


def _seconds_of(kind: pa.DataType) -> float | None:
    """Return the unit of times, in seconds; None for what is no time."""
    known = pa.types.is_timestamp, pa.types.is_duration, pa.types.is_time64, pa.types.is_time32
    return _UNITS[kind.unit] if any(one(kind) for one in known) else None


def _seconds(column: pa.ChunkedArray, unit: float) -> Frames:
    """Return times in seconds from the first one, NaN for null."""
    whole = pa.int32() if pa.types.is_time32(column.type) else pa.int64()
    counts = column.cast(whole)
    first = next((count.as_py() for count in counts if count.is_valid), 0)
    return _floats(pc.subtract(counts, pa.scalar(first, whole))) * unit


def _floats(column: pa.ChunkedArray) -> Frames:
    """Return the numbers of a column, NaN for null; 32-bit floats are numbers of 64 bits too."""
    return np.asarray(column.cast(pa.float64(), safe=False).to_numpy())
