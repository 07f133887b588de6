"""Separated values: a column of times and one column a channel."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.tables.columns import sort_columns, table_recording
from mocapbench.datasets.formats.tables.dialect import dialect_of
from mocapbench.datasets.formats.tables.header import check_lines, column_names
from mocapbench.datasets.formats.text.lines import read_lines, write_lines
from mocapbench.datasets.formats.text.numbers import is_missing, looks_numeric
from mocapbench.datasets.formats.text.rows import TextTable
from mocapbench.datasets.recording import FrameByChannel, Mask, Recording

__all__ = ["CSVFormat"]


class CSVFormat(Format):
    r"""Comma-separated values (.csv): a column of times, one column a channel.

    The first line names the columns. ``time`` is in seconds; without it, reading takes a rate. A
    channel may state its unit in brackets, such as ``knee.rx [deg]``, or a known one in
    parentheses, ``knee.rx (deg)``; angles are unwrapped only if it is ``deg`` or ``rad``. Cells
    that are empty, NaN, NA or null are hidden. A count of frames and columns of text are no
    channels, and are kept as they are; a column that is mostly numbers has to be all numbers.

    Semicolons or tabs may stand between columns, as the first line has them. Numbers may then have
    decimal commas, and are written as they were read.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from mocapbench.datasets import CSVFormat
    >>> with TemporaryDirectory() as folder:
    ...     given, out = Path(folder, "walk.csv"), Path(folder, "filled.csv")
    ...     _ = given.write_text("time;knee [deg]\n0;1,50\n0,1;\n0,2;2,50\n")
    ...     walk = CSVFormat().read(given)
    ...     CSVFormat().write(out, walk.with_values([[1.5], [2.0], [2.5]]), like=given)
    ...     out.read_text().splitlines()
    ['time;knee [deg]', '0;1,50', '0,1;2,0', '0,2;2,50']
    """

    suffixes = (".csv",)
    memory_per_byte = 12.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        table = _table(path)
        columns = sort_columns(table.names, _are_numbers(table))
        leading = () if rate is not None or columns.time is None else (columns.time,)
        values = table.numbers([*leading, *columns.channels])
        times = values[:, 0] if leading else None
        channels = values[:, len(leading) :]
        return table_recording(path.name, table.names, columns, (times, channels), rate)

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's lines with the new cells."""
        table = _table(like)
        columns = sort_columns(table.names, _are_numbers(table))
        write_lines(path, table.with_numbers(columns.channels, values, new), like)


def _table(path: Path) -> TextTable:
    """Return the rows below the names of the columns."""
    lines = read_lines(path)
    check_lines(path.name, lines)
    cells, decimal = dialect_of(lines)
    names = column_names(path.name, lines, cells)
    return TextTable(path.name, lines, 1, cells, len(names), len(names), decimal, names)


def _are_numbers(table: TextTable) -> list[bool]:
    """Return whether each column has numbers, or nothing: if its first cell does not tell, all do.

    Of different texts and numbers, the half or more are numbers; so a mark of missing values that
    is repeated counts once.
    """
    first = _first_cells(table)
    unsure = [column for column, cell in first.items() if not looks_numeric(cell)]
    different: dict[int, set[str]] = {column: set() for column in unsure}
    for index in table.rows if unsure else ():
        row = table.row(index)
        for column in unsure:
            different[column].add(row[column])
    text = {column for column in unsure if not _mostly_numeric(different[column])}
    return [column not in text for column in range(table.width)]


def _first_cells(table: TextTable) -> dict[int, str]:
    """Return the first cell of each column that is not missing, if there is one."""
    first: dict[int, str] = {}
    for index in table.rows:
        row = enumerate(table.row(index)[: table.width])
        first |= {k: cell for k, cell in row if k not in first and not is_missing(cell)}
        if len(first) == table.width:
            break
    return first


def _mostly_numeric(cells: Iterable[str]) -> bool:
    numeric = [looks_numeric(cell) for cell in cells if not is_missing(cell)]
    return 2 * sum(numeric) >= len(numeric)
