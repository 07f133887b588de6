"""What the columns of a table are, by their names: time, a count of frames, or channels."""

from __future__ import annotations

import re
import warnings
from collections.abc import Sequence
from typing import NamedTuple

from mocapbench.datasets.formats.building import even_times, recording_of
from mocapbench.datasets.formats.errors import FormatError, TextColumnsWarning
from mocapbench.datasets.recording import FrameByChannel, Frames, Recording

__all__ = ["TableColumns", "sort_columns", "table_recording"]

_TIME = frozenset({"time", "time [s]", "time (s)", "time_s", "t", "seconds"})
_COUNT = frozenset({"", "frame", "frame#", "frames", "__index_level_0__"})  # pandas' own index
_SYNONYMS = {"°": "deg", "degree": "deg", "degrees": "deg", "radian": "rad", "radians": "rad"}
_KNOWN = "|".join(["deg", "rad", "mm", "cm", "m", *_SYNONYMS])
_IN_BRACKETS = re.compile(r"(.*\S)\s*\[([^\]]*)\]")
_IN_PARENTHESES = re.compile(rf"(.*\S)\s*\(\s*((?:{_KNOWN})(?:/s)?)\s*\)", re.IGNORECASE)
"""Only known units, since a name may be such as ``knee (left)``."""


class TableColumns(NamedTuple):
    """Indices of columns."""

    time: int | None
    """The column of seconds, if there is one."""
    channels: tuple[int, ...]
    """Those of numbers."""
    left_out: tuple[int, ...]
    """Those of something else."""


def sort_columns(names: Sequence[str], is_number: Sequence[bool]) -> TableColumns:
    """Return which columns are time and channels.

    Parameters
    ----------
    names : sequence of str
        Column ``time`` is in seconds (also ``time [s]``, ``time_s``, ``t``, ``seconds``); ``frame``
        and a column without a name count the frames. Case does not matter.
    is_number : sequence of bool
        Whether a column has numbers; others are left out.
    """
    plain = [name.strip().lower() for name in names]
    times = [index for index, name in enumerate(plain) if name in _TIME]
    apart = {*times[:1], *(index for index, name in enumerate(plain) if name in _COUNT)}
    others = [index for index in range(len(names)) if index not in apart]
    channels = tuple(index for index in others if is_number[index])
    left_out = tuple(index for index in others if not is_number[index])
    return TableColumns(times[0] if times else None, channels, left_out)


def table_recording(
    file: str,
    names: Sequence[str],
    columns: TableColumns,
    values: tuple[Frames | None, FrameByChannel],
    rate: float | None,
) -> Recording:
    """Return the recording of a table.

    Parameters
    ----------
    file : str
        Name of the file.
    names : sequence of str
        Names of all columns; a channel such as ``knee.rx [deg]`` has the unit in brackets, or
        a known one in parentheses.
    columns : TableColumns
    values : tuple of ndarray (N,) or None and ndarray (N, D)
        The column of times, if there is one, and the channels.
    rate : float or None
        Frames per second in place of the times.

    Raises
    ------
    FormatError
        If neither a rate nor a column of times is given, or as `recording_of`.

    Warns
    -----
    TextColumnsWarning
        If columns are left out, as they are not numbers.
    """
    times, channels = values
    if rate is not None:
        times = even_times(len(channels), rate)
    if times is None:
        raise FormatError(
            file,
            "a column 'time' in seconds, or a rate",
            f"the columns {', '.join(names[:4])}{', …' if len(names) > 4 else ''}",
            "name the rate in frames per second, such as --rate 100",
        )
    if columns.left_out:
        left_out = ", ".join(names[index] for index in columns.left_out)
        text = f"{file}: left out, as they are not numbers: {left_out}"
        warnings.warn(text, TextColumnsWarning, stacklevel=2)
    named = [_channel(names[index]) for index in columns.channels]
    return recording_of(
        file, times, channels, [name for name, _ in named], [unit for _, unit in named]
    )


def _channel(name: str) -> tuple[str, str]:
    """Return the name and the unit that a column's name states."""
    name = name.strip()
    known = _IN_PARENTHESES.fullmatch(name)
    found = known or _IN_BRACKETS.fullmatch(name)
    if found is None:
        return name, ""
    unit = found[2].lower() if known else found[2].strip()
    return found[1], _SYNONYMS.get(unit.lower(), unit)
