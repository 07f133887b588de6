"""TRC (track row column): the positions of markers as text, of OpenSim and Motion Analysis."""

# Why not by a library: trc-data-reader 0.4 gives a marker with an empty cell the coordinates of the
# next, reads nothing of rows with more cells than names, and writes a head of its own.

from __future__ import annotations

import warnings
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import ClassVar

from mocapbench.datasets.formats.errors import FormatError, FormatWarning
from mocapbench.datasets.formats.markers.channels import marker_channels
from mocapbench.datasets.formats.markers.trc_head import LEADING, TRCHead, parse_head
from mocapbench.datasets.formats.missing_rows import counts_frames
from mocapbench.datasets.formats.tables.columns import TableColumns
from mocapbench.datasets.formats.tables.dialects import Dialect
from mocapbench.datasets.formats.tables.heads import Head
from mocapbench.datasets.formats.tables.labels import Label
from mocapbench.datasets.formats.tables.plan import plan_wide
from mocapbench.datasets.formats.tables.sheet import Sheet
from mocapbench.datasets.formats.tables.table_format import TextTableFormat
from mocapbench.datasets.formats.text.cells import CellSplitter, Separated
from mocapbench.datasets.formats.text.lines import read_lines
from mocapbench.datasets.formats.text.rows import SpacedTable, TextTable
from mocapbench.datasets.recording import Frames

__all__ = ["TRCFormat"]

_DIALECT = Dialect(program="TRC", sign="")
_FRAME, _TIME = range(LEADING)


class TRCFormat(TextTableFormat):
    """Positions of markers (.trc), as OpenSim, Cortex, Mokka and people write them.

    The channels are ``LKNE.x``, ``LKNE.y``, ``LKNE.z`` and so on, in the unit that the file states;
    columns without a name are those of a marker ``unlabelled``. Coordinates whose cells are empty
    or NaN are hidden; a marker at the origin is one at the origin. The rows that there are count:
    what the head says of them otherwise is warned of. Every line keeps its numbers, but for the
    coordinates that are filled.

    Parameters
    ----------
    inserts : bool
        Whether rows that are missing, as times or frames show, are read as hidden frames, and are
        written.
    """

    suffixes: ClassVar[tuple[str, ...]] = (".trc",)

    def sheet(self, path: Path) -> Sheet[TextTable]:
        """Return the table of a file, without rows that are missing."""
        head, markers, table = _parse(path)
        labels = _label_columns(markers, head.facts.get("Units", ""))
        table = replace(table, names=[label.name for label in labels])
        numbers = _read_numbers(table)
        n_frames = len(numbers[_TIME])
        _check_end(table, head.count("NumFrames"), n_frames)
        _warn_of_counts(path.name, head, markers, n_frames)
        notation, rows = (table.cells, table.decimal), (head.start, len(table.lines))
        above = Head(_DIALECT, notation, *rows, labels, head.count("DataRate"))
        frame = _FRAME if _FRAME in numbers else None
        columns = TableColumns(_TIME, frame, tuple(range(LEADING, table.width)), (), {})
        return Sheet(table, (), above, columns, numbers, *plan_wide(n_frames))


def _parse(path: Path) -> tuple[TRCHead, Sequence[str], TextTable]:
    """Return the head of a file, the names of its markers, and its rows."""
    lines = read_lines(path)
    head = parse_head(path.name, lines)
    table = SpacedTable(path.name, lines, head.start, head.cells, LEADING, LEADING)
    widest = max((_n_used(head.cells.split(lines[k])) for k in table.rows), default=LEADING)
    markers = head.markers(path.name, max(widest - LEADING, 0))
    width, decimal = LEADING + 3 * len(markers), _decimal_mark(head.cells, table)
    return head, markers, replace(table, width=width, decimal=decimal)


def _label_columns(markers: Sequence[str], unit: str) -> list[Label]:
    coordinates = [Label(name, unit) for name in marker_channels(markers)]
    return [Label("Frame#"), Label("Time"), *coordinates]


def _read_numbers(table: TextTable) -> dict[int, Frames]:
    """Return the columns of numbers; those of frames only if they count."""
    values = table.numbers(range(LEADING - 1, table.width))
    numbers = dict(enumerate(values.T, start=LEADING - 1))
    with suppress(FormatError):
        frames = table.numbers([_FRAME])[:, 0]
        numbers |= {_FRAME: frames} if counts_frames(frames) else {}
    return numbers


def _n_used(cells: Sequence[str]) -> int:
    """Return how many cells there are up to the last one that is not empty."""
    n_cells = len(cells)
    while n_cells and not cells[n_cells - 1].strip():
        n_cells -= 1
    return n_cells


def _decimal_mark(cells: CellSplitter, table: TextTable) -> str:
    """Return the mark that the first row with a point or a comma has."""
    if cells == Separated(","):
        return "."
    marked = (table.lines[k] for k in table.rows if "." in table.lines[k] or "," in table.lines[k])
    return "." if "." in next(marked, ".") else ","


def _check_end(table: TextTable, stated: float | None, n_frames: int) -> None:
    """Refuse a last row that is cut off, where more rows are stated."""
    if n_frames < 2 or stated is None or n_frames >= stated:
        return
    before, last = table.rows[-2:]
    usual, n_cells = (len(table.cells.split(table.lines[k])) for k in (before, last))
    if n_cells < usual and not table.lines[last].endswith(("\r", "\n")):
        advice = "copy or export the file again, or delete this line"
        expected, got = f"{usual} cells, as above", f"{n_cells} cells"
        raise FormatError(table.file, expected, got, advice, last + 1)


def _warn_of_counts(file: str, head: TRCHead, markers: Sequence[str], n_frames: int) -> None:
    """Warn of what the head says otherwise than the rows."""
    n_markers, n_named = len(markers), sum(map(bool, markers))
    columns = f"columns of {n_markers}" + f", {n_named} with names" * (n_named < n_markers)
    found = {"NumFrames": (n_frames, f"{n_frames} rows"), "NumMarkers": (n_markers, columns)}
    for fact, (count, got) in found.items():
        stated = head.count(fact)
        if stated is not None and stated != count:
            warnings.warn(
                f"{file}: expected {fact} to be {stated:g}, as line 3 says, got {got}, which are "
                "read; if something is missing, copy or export the file again",
                FormatWarning,
                stacklevel=2,
            )
