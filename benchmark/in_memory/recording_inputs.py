"""Recordings of what a notebook has: files, tables, arrays, datasets of xarray."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import singledispatch
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench.benchmark.formats import format_for
from mocapbench.benchmark.in_memory.arguments import require_positive, translate_errors
from mocapbench.benchmark.in_memory.movement import read_movement
from mocapbench.benchmark.in_memory.tables import read_frame
from mocapbench.benchmark.missing_values import choose_missing_rule
from mocapbench.benchmark.recording_checks.hidden_spikes import tell_spikes
from mocapbench.benchmark.recording_checks.reading import Reading
from mocapbench.datasets import Format, Recording, unwrap_angles

__all__ = ["FileRecording", "read"]

ArrayOfAny = NDArray[Any]


@dataclass(frozen=True, eq=False)
class FileRecording(Recording):
    """A recording that knows the file that it was read from.

    Parameters
    ----------
    name : str
        What messages call it.
    times : array_like of shape (N,)
        Seconds.
    values : array_like of shape (N, D)
        NaN marks what is hidden.
    channels : sequence of D str
        Names, all different.
    units : sequence of D str
        The unit of each channel.
    path : Path
        The file.
    format : Format
        In which it is read and written.
    results : tuple of str
        Its channels that are results of a model of the body, not measured.
    remarks : tuple of str
        What is to be said of missing values in the file.
    """

    path: Path
    format: Format
    results: tuple[str, ...]
    remarks: tuple[str, ...]


def read(source: Any, **options: Any) -> Recording:
    """Return a recording of a file, a table, an array or a dataset.

    Parameters
    ----------
    source : path, DataFrame, ndarray, xarray.Dataset, xarray.DataArray or Recording
        A file of any format that is registered. A table with a row a frame and a column a channel,
        called as in a CSV file, such as ``"knee [deg]"``; times are its index in seconds or a
        column called time. An array (frames, channels). A dataset of the package movement, with the
        dimensions time, space, keypoints and, if there are several, individuals. NaN marks what is
        hidden, as does the mask of an array.
    **options
        Of a file: ``rate`` in frames per second, ``min_likelihood``, ``insert_missing``,
        ``missing`` and ``hide_spikes``, as ``mocapbench fill`` has them. Of a table: ``rate``,
        ``name`` and ``min_likelihood``. Of an array: ``rate``, which it needs, ``names`` and
        ``units`` of its channels, and ``name``. Of a dataset: ``rate``, ``name`` and
        ``min_likelihood``, of its confidence.

    Returns
    -------
    Recording
        Angles are unwrapped. That of a file knows its file, so that it can be saved like it.

    Raises
    ------
    ValueError
        If it is no recording; the message says what was expected and got.

    Examples
    --------
    >>> import numpy as np
    >>> import mocapbench
    >>> walk = mocapbench.read(np.array([[0.0], [np.nan], [2.0]]), rate=30, names=["knee"])
    >>> walk.times.round(3), walk.visible[:, 0]
    (array([0.   , 0.033, 0.067]), array([ True, False,  True]))
    """
    convert = _find_converter(source)
    _check_options(convert, options)
    with translate_errors():
        return convert(source, **options)


def _check_options(convert: Callable[..., Recording], options: dict[str, Any]) -> None:
    """Refuse options that this kind of source does not have."""
    _, *known = inspect.signature(convert).parameters
    others = [name for name in options if name not in known]
    if others:
        raise ValueError(
            f"expected options {', '.join(known) or 'none'} for what is read here, "
            f"got {', '.join(others)}"
        )


@singledispatch
def _find_converter(source: object) -> Callable[..., Recording]:
    """Return what turns such a source into a recording."""
    if type(source).__module__.partition(".")[0] == "xarray":
        return read_movement
    raise ValueError(
        "expected the path of a file, a DataFrame, an array, a dataset of xarray or a Recording, "
        f"got {type(source).__name__}"
    )


@_find_converter.register
def _(source: str) -> Callable[..., Recording]:
    del source
    return _read_file


@_find_converter.register
def _(source: Path) -> Callable[..., Recording]:
    del source
    return _read_file


@_find_converter.register
def _(source: pd.DataFrame) -> Callable[..., Recording]:
    del source
    return read_frame


@_find_converter.register
def _(source: np.ndarray) -> Callable[..., Recording]:
    del source
    return _read_array


@_find_converter.register
def _(source: Recording) -> Callable[..., Recording]:
    del source
    return _keep


def _keep(source: Recording) -> Recording:
    return source


def _read_file(
    source: str | Path,
    *,
    rate: float | None = None,
    min_likelihood: float | None = None,
    insert_missing: bool = False,
    missing: str | float | None = None,
    hide_spikes: bool = False,
) -> FileRecording:
    path = Path(source)
    rule = choose_missing_rule(None if missing is None else str(missing))
    spike_rule = tell_spikes if hide_spikes else None
    reading = Reading(rate, min_likelihood, insert_missing, rule, spike_rule)
    recording, remarks = reading.read(path)
    results = format_for(path).results(path, recording.channels)
    spikes, said_of_spikes = reading.find_spikes(recording, results)
    recording = recording.hide(spikes)
    return FileRecording(
        str(path),
        recording.times,
        recording.values,
        recording.channels,
        recording.units,
        path=path,
        format=reading.format_of(path),
        results=results,
        remarks=(*remarks, *said_of_spikes),
    )


def _read_array(
    source: ArrayOfAny,
    rate: float | None = None,
    names: Sequence[str] | None = None,
    units: str | Sequence[str] = "",
    name: str = "recording",
) -> Recording:
    if source.ndim != 2 or not source.size:
        raise ValueError(f"expected an array (frames, channels), got shape {source.shape}")
    if source.dtype.kind != "f":
        raise ValueError(
            f"expected floating-point numbers, NaN where an entry is hidden, got {source.dtype}; "
            "mark what is missing, and convert it by .astype(float)"
        )
    fps = require_positive("rate", rate, "in frames per second, ")
    n_frames, n_channels = source.shape
    channels = [f"channel {n}" for n in range(n_channels)] if names is None else list(names)
    if len(channels) != n_channels:
        raise ValueError(
            f"expected names= of {n_channels} channels, as the array has, got {len(channels)}"
        )
    kinds = [units] * n_channels if isinstance(units, str) else list(units)
    times, values = np.arange(n_frames) / fps, np.ma.filled(source, np.nan)
    return unwrap_angles(Recording(name, times, values, tuple(channels), tuple(kinds)))
