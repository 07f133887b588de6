"""Comma-separated values: a column of times and one column a channel."""

from __future__ import annotations

from pathlib import Path

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.tables.columns import sort_columns, table_recording
from mocapbench.datasets.formats.text.numbers import is_missing, numeric
from mocapbench.datasets.formats.text.rows import Separated, Table, read_lines, write_lines
from mocapbench.datasets.recording import FrameByChannel, Mask, Recording

__all__ = ["CSVFormat"]

_CELLS = Separated(",")


class CSVFormat(Format):
    r"""Comma-separated values (.csv): a column of times, one column a channel.

    The first line names the columns. ``time`` is in seconds; without it, reading takes a rate. A
    channel may state its unit in brackets, such as ``knee.rx [deg]``, or a known one in
    parentheses, ``knee.rx (deg)``; angles are unwrapped only if it is ``deg`` or ``rad``. Cells
    that are empty, NaN, NA or null are hidden. A count of frames and columns of text are no
    channels, and are kept as they are.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from mocapbench.datasets import CSVFormat
    >>> with TemporaryDirectory() as folder:
    ...     given, out = Path(folder, "walk.csv"), Path(folder, "filled.csv")
    ...     _ = given.write_text("time,knee [deg],side\n0,1.50,left\n0.1,,left\n0.2,2.50,left\n")
    ...     walk = CSVFormat().read(given)
    ...     CSVFormat().write(out, walk.with_values([[1.5], [2.0], [2.5]]), like=given)
    ...     out.read_text().splitlines()
    ['time,knee [deg],side', '0,1.50,left', '0.1,2.0,left', '0.2,2.50,left']
    """

    suffixes = (".csv",)
    memory_per_byte = 12.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        names, table = _table(path)
        columns = sort_columns(names, _are_numbers(table))
        leading = () if rate is not None or columns.time is None else (columns.time,)
        values = table.numbers([*leading, *columns.channels])
        times = values[:, 0] if leading else None
        channels = values[:, len(leading) :]
        return table_recording(path.name, names, columns, (times, channels), rate)

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's lines with the new cells."""
        names, table = _table(like)
        columns = sort_columns(names, _are_numbers(table))
        write_lines(path, table.with_numbers(columns.channels, values, new))


def _table(path: Path) -> tuple[list[str], Table]:
    """Return the names of the columns, and the rows below them."""
    lines = read_lines(path)
    names = [name.strip() for name in _CELLS.split(lines[0])] if lines else []
    if not any(map(_is_name, names)):
        raise FormatError(
            path.name,
            "the names of the columns, with commas between them",
            repr(lines[0][:60].rstrip()) if lines else "an empty file",
            "write such as 'time,hip.x [cm],hip.y [cm]' in the first line",
            line=1,
        )
    if len(names) == 1 and (";" in names[0] or "\t" in names[0]):
        advice = "export with commas between columns and points in numbers"
        raise FormatError(path.name, "commas between columns", repr(names[0][:60]), advice, line=1)
    return names, Table(path.name, lines, 1, _CELLS, len(names), len(names))


def _is_name(cell: str) -> bool:
    return not is_missing(cell) and not _is_number(cell)


def _is_number(cell: str) -> bool:
    try:
        numeric([cell])
    except ValueError:
        return False
    return True


def _are_numbers(table: Table) -> list[bool]:
    """Return whether the first cell of each column that is not missing is a number."""
    first: dict[int, str] = {}
    for index in range(table.start, table.stop):
        row = table.row(index)
        first |= {
            k: cell
            for k, cell in enumerate(row[: table.width])
            if k not in first and not is_missing(cell)
        }
        if len(first) == table.width:
            break
    return [_is_number(first.get(k, "")) for k in range(table.width)]
