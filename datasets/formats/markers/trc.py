"""TRC (track row column): the positions of markers as text, of OpenSim and Motion Analysis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.building import even_times, recording_of
from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.markers.channels import marker_channels
from mocapbench.datasets.formats.text.cells import Separated
from mocapbench.datasets.formats.text.lines import read_lines, write_lines
from mocapbench.datasets.formats.text.rows import TextTable
from mocapbench.datasets.recording import FrameByChannel, Mask, Recording

__all__ = ["TRCFormat"]

_CELLS = Separated("\t")
_HEAD = 5
_LEADING = 2  # the number of the frame, and its time


class TRCFormat(Format):
    """Positions of markers (.trc), as OpenSim and Motion Analysis write them.

    The channels are ``LKNE.x``, ``LKNE.y``, ``LKNE.z`` and so on, in the unit that the file states.
    Coordinates whose cells are empty or NaN are hidden; a marker at the origin is one at the
    origin. Every line keeps its numbers, but for the coordinates that are filled.
    """

    suffixes = (".trc",)
    memory_per_byte = 12.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        head, table = _parse_table(path)
        values = table.numbers(range(1, table.width))
        _check_count(path.name, head, len(values))
        times = values[:, 0] if rate is None else even_times(len(values), rate)
        channels = marker_channels(head.markers)
        units = [head.facts.get("Units", "")] * len(channels)
        return recording_of(path.name, times, values[:, 1:], channels, units)

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's lines with the new coordinates."""
        _, table = _parse_table(like)
        columns = range(_LEADING, table.width)
        write_lines(path, table.with_numbers(columns, values, new), like)


@dataclass(frozen=True)
class _Head:
    """The first five lines.

    Parameters
    ----------
    facts : mapping of str to str
        What the second and third line state, such as ``NumFrames``.
    markers : sequence of str
    """

    facts: Mapping[str, str]
    markers: Sequence[str]


def _parse_table(path: Path) -> tuple[_Head, TextTable]:
    lines = read_lines(path)
    rows = [[cell.strip() for cell in _CELLS.split(line)] for line in lines[:_HEAD]]
    if len(rows) < _HEAD or rows[0][:1] != ["PathFileType"] or rows[3][:1] != ["Frame#"]:
        raise FormatError(
            path.name,
            f"{_HEAD} lines of head, the first with 'PathFileType' and the fourth with 'Frame#'",
            repr(lines[0][:60].rstrip()) if lines else "an empty file",
            "export the markers as TRC, with tabs between cells",
        )
    facts = dict(zip(rows[1], rows[2], strict=False))
    markers = [name for name in rows[3][_LEADING:] if name]
    if facts.get("NumMarkers") != str(len(markers)):
        advice = "correct NumMarkers, or export the markers again"
        expected = f"{facts.get('NumMarkers', 'NumMarkers')} markers, as line 3 says"
        raise FormatError(path.name, expected, f"{len(markers)} names", advice, line=4)
    start = next((k for k in range(_HEAD, len(lines)) if lines[k].strip()), len(lines))
    width = _LEADING + 3 * len(markers)
    return _Head(facts, markers), TextTable(path.name, lines, start, _CELLS, width, _LEADING)


def _check_count(file: str, head: _Head, n_frames: int) -> None:
    stated = head.facts.get("NumFrames", "")
    if stated != str(n_frames):
        advice = "the file may be cut short: export it again, or correct NumFrames"
        got = f"{n_frames} rows"
        raise FormatError(file, f"{stated or 'NumFrames'} frames, as line 3 says", got, advice)
