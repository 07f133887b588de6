"""TRC (track row column): the positions of markers as text, of OpenSim and Motion Analysis."""

# Why not by a library: trc-data-reader 0.4 gives a marker with an empty cell the coordinates of the
# next, reads nothing of rows with more cells than names, and writes a head of its own.

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.building import (
    even_times,
    recording_of,
    warn_of_missing_rows,
)
from mocapbench.datasets.formats.errors import FormatError, FormatWarning
from mocapbench.datasets.formats.markers.channels import marker_channels
from mocapbench.datasets.formats.markers.trc_head import LEADING, TRCHead, parse_head
from mocapbench.datasets.formats.text.cells import CellSplitter, Separated
from mocapbench.datasets.formats.text.lines import read_lines, write_lines
from mocapbench.datasets.formats.text.rows import TextTable
from mocapbench.datasets.recording import FrameByChannel, Mask, Recording

__all__ = ["TRCFormat"]


class TRCFormat(Format):
    """Positions of markers (.trc), as OpenSim, Cortex, Mokka and people write them.

    The channels are ``LKNE.x``, ``LKNE.y``, ``LKNE.z`` and so on, in the unit that the file states;
    columns without a name are those of a marker ``unlabelled``. Coordinates whose cells are empty
    or NaN are hidden; a marker at the origin is one at the origin. The rows that there are count:
    what the head says of them otherwise is warned of. Every line keeps its numbers, but for the
    coordinates that are filled.
    """

    suffixes = (".trc",)
    memory_per_byte = 12.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        head, markers, table = _parse(path)
        values = table.numbers(range(LEADING - 1, table.width))
        _check_end(table, head.count("NumFrames"), len(values))
        _warn_of_counts(path.name, head, markers, len(values))
        times = values[:, 0] if rate is None else even_times(len(values), rate)
        channels = marker_channels(markers)
        units = [head.facts.get("Units", "")] * len(channels)
        recording = recording_of(path.name, times, values[:, 1:], channels, units)
        warn_of_missing_rows(recording)
        return recording

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's lines with the new coordinates."""
        _, _, table = _parse(like)
        columns = range(LEADING, table.width)
        write_lines(path, table.with_numbers(columns, values, new), like)


class _SpacedTable(TextTable):
    """Rows among which lines may be blank."""

    @property
    def rows(self) -> Sequence[int]:
        """Indices of the lines that are rows."""
        return [k for k in super().rows if self.lines[k].strip()]


def _parse(path: Path) -> tuple[TRCHead, Sequence[str], TextTable]:
    """Return the head of a file, the names of its markers, and its rows."""
    lines = read_lines(path)
    head = parse_head(path.name, lines)
    table = _SpacedTable(path.name, lines, head.start, head.cells, LEADING, LEADING)
    widest = max((_n_used(head.cells.split(lines[k])) for k in table.rows), default=LEADING)
    markers = head.markers(path.name, max(widest - LEADING, 0))
    width, decimal = LEADING + 3 * len(markers), _decimal_mark(head.cells, table)
    return head, markers, replace(table, width=width, decimal=decimal)


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
