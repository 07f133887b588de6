"""The head of a TRC file: what it states, and which columns are of which marker.

By OpenSim's documentation ("Marker (.trc) Files"), a line begins with PathFileType, one has the
names of facts and the next one their values, one has Frame#, Time and the name of each marker above
the first of its three columns, and one has X1, Y1, Z1 and so on. Files of Cortex, of Mokka, of
OpenSim's own examples and those that somebody edited depart from this: counts are wrong, markers
have no names, blanks stand for tabs, lines are missing. What the rows have decides.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.text.cells import CellSplitter, Separated, Words
from mocapbench.datasets.formats.text.numbers import is_number, looks_numeric

__all__ = ["LEADING", "TRCHead", "parse_head"]

LEADING = 2
"""Columns before those of markers: the number of the frame, and its time."""
_LONGEST = 20  # lines in which the names of the markers are looked for
_SEPARATORS = ("\t", ";", ",")


@dataclass(frozen=True)
class TRCHead:
    """The lines above the rows.

    Parameters
    ----------
    facts : mapping of str to str
        What the file states, such as ``NumFrames``.
    names : sequence of str
        The cells above those of markers, of which the last one is not empty.
    names_at : int
        Index of their line.
    start : int
        Index of the first row.
    cells : CellSplitter
        How cells are told apart.
    """

    facts: Mapping[str, str]
    names: Sequence[str]
    names_at: int
    start: int
    cells: CellSplitter

    def count(self, fact: str) -> float | None:
        """Return a count that is stated, perhaps with decimals; None if there is none."""
        stated = self.facts.get(fact, "").replace(",", ".")
        return float(stated) if is_number(stated, ".") else None

    def markers(self, file: str, n_columns: int) -> list[str]:
        """Return the name of each marker, which is empty if it has none.

        Parameters
        ----------
        file : str
            Name of the file in errors.
        n_columns : int
            Columns of markers in the widest row, of which empty ones may be left out at the end.

        Raises
        ------
        FormatError
            If it cannot be told which columns are below a name.
        """
        places = [place for place, name in enumerate(self.names) if name]
        steps = {after - before for before, after in pairwise(places)}
        as_many = -(-n_columns // 3) == len(places)
        # Names at other even distances stand one after another, as if blanks were between them.
        if as_many and len(steps) == 1:
            return [self.names[place] for place in places]
        if any(place % 3 for place in places):
            advice = "write each name above the first of its marker's three columns"
            got = f"{len(places)} names for {n_columns} columns"
            expected = "a name for every three columns"
            raise FormatError(file, expected, got, advice, self.names_at + 1)
        named = self.names[::3]
        return [*named, *[""] * (n_columns // 3 - len(named))]


def parse_head(file: str, lines: Sequence[str]) -> TRCHead:
    """Return the head of a file's lines.

    Raises
    ------
    FormatError
        If no line names the markers.
    """
    written = [k for k, line in enumerate(lines[:_LONGEST]) if line.strip()]
    names_at = next((k for k in written if _names_markers(lines[k])), None)
    if names_at is None:
        expected = "a line that begins with 'Frame#' and names the markers"
        got = repr(lines[0][:60].rstrip()) if lines else "an empty file"
        raise FormatError(file, expected, got, "export the markers as TRC")
    cells = _splitter(lines[names_at])
    facts = _facts([_split_line(cells, lines[k]) for k in written if k < names_at])
    names = _split_line(cells, lines[names_at].rstrip())[LEADING:]
    start = next((k for k in written if k > names_at), names_at + 1)
    is_row = start < len(lines) and any(map(looks_numeric, cells.split(lines[start])))
    return TRCHead(facts, names, names_at, start + (not is_row), cells)


def _names_markers(line: str) -> bool:
    return line.lstrip(' "').lower().startswith("frame")


def _splitter(names: str) -> CellSplitter:
    """Return what separates the cells of the line that names the markers: blanks, if nothing."""
    found = next((separator for separator in _SEPARATORS if separator in names), None)
    return Words() if found is None else Separated(found)


def _split_line(cells: CellSplitter, line: str) -> list[str]:
    return [cell.strip() for cell in cells.split(line)]


def _facts(rows: Sequence[Sequence[str]]) -> dict[str, str]:
    """Return the values of the line below that with DataRate, by the names above them.

    If there are as many words in both lines, blanks and empty cells between them do not count.
    """
    for names, values in pairwise(rows):
        if names[0].lower().startswith("datarate"):
            words = [[word for cell in row for word in cell.split()] for row in (names, values)]
            matched = words if len(words[0]) == len(words[1]) else [names, values]
            return dict(zip(*matched, strict=False))
    return {}
