"""Times that are those of a clock, perhaps with a date: ``2026-01-31T10:00:00.010Z``, ``00:01.25``.

Of dates and zones only the order matters: a clock that goes back has passed midnight.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.tables.columns import is_time
from mocapbench.datasets.formats.tables.plan import RowTable
from mocapbench.datasets.recording import Frames

__all__ = ["is_clock", "read_clocks", "set_clock"]

_CLOCK = re.compile(
    r"""(?P<before>\s*(?:\d{1,4}[-/.](?:\d{1,2}|[a-zäéû]{3,9}\.?)[-/.]\d{1,4}[T\s]+)?)
    (?:(?P<hours>\d{1,2}):)?(?P<minutes>\d{1,2}):(?P<seconds>\d{1,2}(?:[.,]\d+|:\d{3})?)
    (?P<behind>\s*(?P<half>[AP]M)?\s*(?:[A-Z]{1,5}|[+\-]\d{2}:?(?:\d{2})?)?(?:\[[^\]]*\])?\s*)""",
    re.VERBOSE | re.IGNORECASE,
)
_MINUTE, _HOUR, _DAY = 60.0, 3600.0, 86400.0


def read_clocks(table: RowTable, is_number: Sequence[bool]) -> dict[int, Frames]:
    """Return the column of times as a clock shows them, in seconds, if no other column has times.

    Raises
    ------
    FormatError
        If one of its cells is no time.
    """
    named = [k for k, name in enumerate(table.names) if is_time(name)]
    if any(is_number[k] for k in named) or not (named and table.rows):
        return {}
    cells = table.texts(named[:1])[named[0]]
    if not is_clock(cells[0]):
        return {}
    seconds = _clock_seconds(cells)
    for row in np.flatnonzero(np.isnan(seconds))[:1]:
        expected, advice = f"a time such as {cells[0]!r}", "correct the time"
        got, line = repr(cells[row][:60]), table.line_of(int(row))
        raise FormatError(table.file, expected, got, advice, line)
    return {named[0]: seconds}


def is_clock(cell: str) -> bool:
    """Return whether a cell is a time of the day, with or without a date before it.

    Examples
    --------
    >>> from mocapbench.datasets.formats.tables.clock_times import is_clock
    >>> list(map(is_clock, ["2026-01-31T10:00:00.5Z", "31.01.2026 10:00:00,5", "00:01.25"]))
    [True, True, True]
    >>> list(map(is_clock, ["31-Jan-2026 10:00:00", "10:00:00:005", "10:00:00+01:00[CET]"]))
    [True, True, True]
    >>> list(map(is_clock, ["10", "2026-01-31", "15:26:46:12.02", "soon"]))
    [False, False, False, False]
    """
    return _CLOCK.fullmatch(cell) is not None


def _clock_seconds(cells: Sequence[str]) -> Frames:
    """Return the seconds of times of the day, which go on behind midnight; NaN where none is."""
    seconds = np.array([_seconds_of_day(cell) for cell in cells])
    steps = np.diff(seconds)
    days = np.cumsum(np.where(steps < -_DAY / 2, _DAY, 0.0))
    after: Frames = seconds + np.concatenate([[0.0], days])[: len(seconds)]
    return after


def set_clock(like: str, seconds: float) -> str:
    """Return a cell like another one with another time of the same day, or an empty one.

    Examples
    --------
    >>> from mocapbench.datasets.formats.tables.clock_times import set_clock
    >>> set_clock("2026-01-31T10:00:00.99Z", 36001.0)
    '2026-01-31T10:00:01.00Z'
    """
    found = _CLOCK.fullmatch(like)
    if found is None or seconds // _DAY != 0:
        return ""
    digits = len(re.split("[.,:]", f"{found['seconds']}.")[1])
    minutes, rest = divmod(round(seconds, digits), _MINUTE)
    hours, minutes = divmod(int(minutes), 60)
    before, behind = found["before"], found["behind"]
    if found["half"]:
        half = "PM" if hours >= 12 else "AM"
        behind, hours = behind.replace(found["half"], half), (hours - 1) % 12 + 1
    written = f"{rest:0{digits + 3 if digits else 2}.{digits}f}"
    mark = next((mark for mark in ",:" if mark in found["seconds"]), ".")
    written = written.replace(".", mark)
    hour = f"{hours:0{len(found['hours'])}}:" if found["hours"] else ""
    return f"{before}{hour}{minutes:02}:{written}{behind}"


def _seconds_of_day(cell: str) -> float:
    found = _CLOCK.fullmatch(cell)
    if found is None:
        return float("nan")
    hours = float(found["hours"] or 0)
    if found["half"]:
        hours = hours % 12 + 12 * (found["half"].upper() == "PM")
    seconds = float(re.sub("[,:]", ".", found["seconds"]))
    return hours * _HOUR + float(found["minutes"]) * _MINUTE + seconds
