"""Tables in memory: a row a frame and a column a channel, called as in a CSV file."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Array
from mocapbench.basics.words import format_count, join_names
from mocapbench.benchmark.in_memory.arguments import require_positive
from mocapbench.datasets import FrameByChannel, Frames, Mask, Recording, unwrap_angles
from mocapbench.datasets.formats.building import recording_of
from mocapbench.datasets.formats.missing_rows import count_missing_rows
from mocapbench.datasets.formats.tables.columns import (
    TableColumns,
    sort_columns,
    split_unit,
    time_unit,
)
from mocapbench.datasets.formats.tables.frame_times import FrameTimes

__all__ = ["read_frame", "require_different_names", "tabulate_values"]

_NAMED = 4
_NANOSECONDS = 1e9


def read_frame(
    table: pd.DataFrame,
    rate: float | None = None,
    name: str = "recording",
    min_likelihood: float | None = None,
) -> Recording:
    """Return the recording of a table.

    Parameters
    ----------
    table : DataFrame
        With a column of times or an index in seconds.
    rate : float or None
        Frames per second, in place of times.
    name : str
        Of the recording.
    min_likelihood : float or None
        Entries whose column of likelihoods has less are hidden.

    Raises
    ------
    ValueError
        If it is no recording.
    """
    names = [_join_levels(column) for column in table.columns]
    _check_columns(names, table)
    if rate is not None:
        require_positive("rate", rate, "in frames per second, ")
    columns = sort_columns(names, [True] * len(names))
    numbers = np.column_stack([_convert_column(table.iloc[:, k]) for k in range(len(names))])
    times = _find_times(name, names, columns, numbers, table.index).seconds(len(table), rate)
    labels = [split_unit(names[column]) for column in columns.channels]
    recording = recording_of(
        name,
        times,
        numbers[:, list(columns.channels)],
        [label for label, _ in labels],
        [unit for _, unit in labels],
    )
    _check_rows(recording, columns, numbers)
    return unwrap_angles(recording.hide(_mark_unlikely(columns, numbers, min_likelihood)))


def _join_levels(column: object) -> str:
    """Return the name of a column; levels of names have dots between them."""
    return ".".join(map(str, column)) if isinstance(column, tuple) else str(column)


def _check_columns(names: Sequence[str], table: pd.DataFrame) -> None:
    """Refuse a table without numbers, with others, or with a name twice."""
    if not table.size:
        raise ValueError(f"expected a row a frame and a column a channel, got shape {table.shape}")
    require_different_names(names)
    kinds = table.dtypes.to_numpy()
    others = [n for n, kind in zip(names, kinds, strict=True) if not _is_number(kind)]
    if others:
        raise ValueError(
            f"expected columns of numbers, got others in {join_names(others, _NAMED)}; leave them "
            "out, or convert them by pandas.to_numeric"
        )
    if all(pd.api.types.is_integer_dtype(kind) for kind in kinds):
        raise ValueError(
            "expected floating-point numbers, NaN where an entry is hidden, got integers alone; "
            "mark what is missing, and convert them by .astype(float)"
        )


def require_different_names(names: Sequence[str]) -> None:
    """Refuse columns of which two have one name."""
    for name, count in Counter(names).most_common(1):
        if count > 1:
            raise ValueError(f"expected columns of different names, got {name!r} {count} times")


def _is_number(kind: Any) -> bool:
    real = pd.api.types.is_numeric_dtype(kind) and not pd.api.types.is_complex_dtype(kind)
    return bool(real or pd.api.types.is_timedelta64_dtype(kind))


def _convert_column(column: Any) -> Array:
    """Return numbers; durations in seconds."""
    if pd.api.types.is_timedelta64_dtype(column.dtype):
        return np.asarray(column.to_numpy("timedelta64[ns]").astype(float) / _NANOSECONDS)
    return np.asarray(column.to_numpy(dtype=float, na_value=np.nan), dtype=np.float64)


def _find_times(
    file: str,
    names: Sequence[str],
    columns: TableColumns,
    numbers: FrameByChannel,
    index: Any,
) -> FrameTimes:
    """Return what columns or the index say about times."""
    times, frames = (None if k is None else numbers[:, k] for k in (columns.time, columns.frame))
    unit = "" if columns.time is None else time_unit(names[columns.time])
    told = isinstance(index, pd.RangeIndex) or not _is_number(index.dtype)
    if times is None and frames is None and not told:
        values = _convert_column(index)
        if pd.api.types.is_integer_dtype(index.dtype):
            return FrameTimes(file, None, "", values, None, names)
        return FrameTimes(file, values, "s", None, None, names)
    return FrameTimes(file, times, unit, frames, None, names)


def _check_rows(recording: Recording, columns: TableColumns, numbers: FrameByChannel) -> None:
    """Refuse a table that lacks rows between others."""
    frames = None if columns.frame is None else numbers[:, columns.frame]
    lacking = count_missing_rows(len(numbers), frames, recording.times)
    if lacking.any():
        after = recording.times[np.flatnonzero(lacking)[0]]
        raise ValueError(
            f"{recording.name}: expected a row for each frame, got none for "
            f"{format_count(int(lacking.sum()), 'frame')}, the first after {after:g} s; add rows "
            "of NaN by .reindex, which are filled, or name rate= if times do not count"
        )


def _mark_unlikely(columns: TableColumns, numbers: FrameByChannel, least: float | None) -> Mask:
    """Return the entries (N, D) that are less likely than the least."""
    mask = np.zeros((len(numbers), len(columns.channels)), dtype=bool)
    for place, column in enumerate(columns.channels):
        if least is not None and column in columns.likelihoods:
            mask[:, place] = numbers[:, columns.likelihoods[column]] < least
    return mask


def tabulate_values(recording: Recording) -> pd.DataFrame:
    """Return a row a frame, indexed by time in seconds, and a column a channel."""
    index: Frames = recording.times
    table = pd.DataFrame(
        recording.values.copy(), pd.Index(index, name="time"), list(recording.channels)
    )
    table.attrs["units"] = dict(zip(recording.channels, recording.units, strict=True))
    return table
