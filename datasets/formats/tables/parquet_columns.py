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

from mocapbench.datasets.recording import Frames, Mask

__all__ = ["read_columns", "write_columns"]

_LONGEST = 100
"""Bytes that cells have on average, at most, to be read as texts: of names, not of notes."""
_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}


def read_columns(path: str) -> Mapping[str, NDArray[Any]]:
    """Return the columns of a file.

    Returns
    -------
    dict of str to ndarray
        ``names`` (C,), ``is_number`` (C,), ``is_time`` (C,) and ``values`` (N, C), those of times
        in seconds, NaN where there is none; of each column k of short texts ``text k``, their bytes
        in UTF-8, and ``ends k``, where each ends in these.
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
        **_read_texts(table),
    }


def write_columns(
    path: Path,
    like: Path,
    rows: NDArray[np.intp],
    entries: Mapping[int, Frames],
    shared: Mapping[int, Frames | Sequence[str]],
) -> None:
    """Write a copy of a file with some entries replaced and some rows added.

    Parameters
    ----------
    path, like : Path
        The file to write, and the one that is copied.
    rows : ndarray of int of shape (R,)
        Which row of the file each row is, or -1 for one that is added.
    entries : mapping of int to ndarray of shape (R,)
        By their columns, numbers to write, NaN for those that stay; integers become floats.
    shared : mapping of int to ndarray of shape (A,) or sequence of A str
        By their columns, what the A added rows have in the type of the column: frames, times in
        seconds after the first row, or names of markers.
    """
    table = _read_table(like)
    if (rows < 0).any():
        table = _add_rows(table, rows)
    for index, values in entries.items():
        if not np.isnan(values).all():
            table = _set_column(table, index, _replace_numbers(table.column(index), values))
    for index, cells in shared.items():
        table = _set_column(table, index, _complete(table.column(index), cells, rows < 0))
    with path.open("wb") as stream:
        pq.write_table(table, stream)


def _add_rows(table: pa.Table, rows: NDArray[np.intp]) -> pa.Table:
    """Return a table with rows without any value where none is named."""
    schema = pa.schema([field.with_nullable(True) for field in table.schema], table.schema.metadata)
    empty = pa.table([pa.nulls(1, field.type) for field in schema], schema=schema)
    both = pa.concat_tables([table.cast(schema), empty])
    return both.take(pa.array(np.where(rows < 0, len(table), rows)))


def _set_column(table: pa.Table, index: int, column: pa.Array) -> pa.Table:
    return table.set_column(index, table.schema.field(index).with_type(column.type), column)


def _replace_numbers(old: pa.ChunkedArray, values: Frames) -> pa.Array:
    """Return numbers with those replaced that are not NaN."""
    new = ~np.isnan(values)
    kind = old.type if pa.types.is_floating(old.type) else pa.float64()
    numbers = np.where(new, values, _floats(old)).astype(kind.to_pandas_dtype())
    return pa.array(numbers, kind, mask=np.asarray(old.is_null()) & ~new)


def _complete(old: pa.ChunkedArray, cells: Frames | Sequence[str], added: Mask) -> pa.Array:
    """Return frames, times or names with the cells of rows that were added."""
    if not isinstance(cells, np.ndarray):
        texts, names = old.cast(pa.large_string()), pa.array(cells, pa.large_string())
        return pc.replace_with_mask(texts, pa.array(added), names).cast(old.type)
    numbers = np.full(len(added), np.nan)
    numbers[added] = cells
    if pa.types.is_floating(old.type):
        return _replace_numbers(old, numbers)
    unit = _seconds_of(old.type)
    counts = old if unit is None else _count_times(old)
    first = 0 if unit is None else _first_known(counts)
    new = ~np.isnan(numbers)
    merged = counts.fill_null(0).to_numpy().copy()
    merged[new] = first + np.round(numbers[new] / (unit or 1.0)).astype(merged.dtype)
    return pa.array(merged, counts.type, mask=np.asarray(old.is_null()) & ~new).cast(old.type)


def _read_texts(table: pa.Table) -> dict[str, NDArray[Any]]:
    texts: dict[str, NDArray[Any]] = {}
    for index, field in enumerate(table.schema):
        if _is_text(field.type) and len(table):
            column = table.column(index).cast(pa.large_string()).fill_null("").combine_chunks()
            array = column.cast(pa.large_binary())
            ends = np.cumsum(pc.binary_length(array).to_numpy())
            if ends[-1] <= _LONGEST * len(table):
                data = b"".join(array.to_pylist())
                texts |= {f"ends {index}": ends, f"text {index}": np.frombuffer(data, np.uint8)}
    return texts


def _read_table(path: Path) -> pa.Table:
    # From a stream: pyarrow takes no name that is not UTF-8, and a folder "a=1" for a column.
    with path.open("rb") as stream:
        return pq.read_table(stream, use_threads=False)


def _is_number(kind: pa.DataType) -> bool:
    return bool(pa.types.is_floating(kind) or pa.types.is_integer(kind))


def _is_text(kind: pa.DataType) -> bool:
    kind = kind.value_type if pa.types.is_dictionary(kind) else kind
    return bool(pa.types.is_string(kind) or pa.types.is_large_string(kind))


def _seconds_of(kind: pa.DataType) -> float | None:
    """Return the unit of times, in seconds; None for what is no time."""
    known = pa.types.is_timestamp, pa.types.is_duration, pa.types.is_time64, pa.types.is_time32
    return _UNITS[kind.unit] if any(one(kind) for one in known) else None


def _seconds(column: pa.ChunkedArray, unit: float) -> Frames:
    """Return times in seconds from the first one, NaN for null."""
    counts = _count_times(column)
    return _floats(pc.subtract(counts, pa.scalar(_first_known(counts), counts.type))) * unit


def _count_times(column: pa.ChunkedArray) -> pa.ChunkedArray:
    """Return times as counts of their unit."""
    return column.cast(pa.int32() if pa.types.is_time32(column.type) else pa.int64())


def _first_known(counts: pa.ChunkedArray) -> int:
    return next((count.as_py() for count in counts if count.is_valid), 0)


def _floats(column: pa.ChunkedArray) -> Frames:
    """Return the numbers of a column, NaN for null; 32-bit floats are numbers of 64 bits too."""
    return np.asarray(column.cast(pa.float64(), safe=False).to_numpy())
