"""The columns of Parquet files by pyarrow; reading is for a process of its own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from mocapbench.datasets.recording import FrameByChannel, Frames, Mask

__all__ = ["read_columns", "write_columns"]


def read_columns(path: str) -> Mapping[str, NDArray[Any]]:
    """Return ``names`` (C,), ``is_number`` (C,) and ``values`` (N, C), NaN where there is none."""
    table = _read_table(Path(path))
    is_number = [_is_number(field.type) for field in table.schema]
    values = np.full((len(table), len(is_number)), np.nan)
    for index in np.flatnonzero(is_number).tolist():
        values[:, index] = _floats(table.column(index))
    return {
        "names": np.array(table.column_names, dtype=np.str_),
        "is_number": np.array(is_number, dtype=bool),
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


def _floats(column: pa.ChunkedArray) -> Frames:
    """Return the numbers of a column, NaN for null; 32-bit floats are numbers of 64 bits too."""
    return np.asarray(column.cast(pa.float64(), safe=False).to_numpy())
