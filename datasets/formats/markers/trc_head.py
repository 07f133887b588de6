"""The head of a TRC file: what it states, and which columns are of which marker.

By OpenSim's documentation ("Marker (.trc) Files"), a line begins with PathFileType, one has the
names of facts and the next one their values, one has Frame#, Time and the name of each marker above
the first of its three columns, and one has X1, Y1, Z1 and so on. Files of Cortex, of Mokka, of
OpenSim's own examples and those that somebody edited depart from this: counts are wrong, markers
have no names, blanks stand for tabs, lines are missing. What the rows have decides.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
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
    separators = [one for one in _SEPARATORS if one in lines[names_at]][:1]
    cells = _find_splitter(lines[names_at], separators)
    facts = _facts([_split_line(cells, lines[k]) for k in written if k < names_at])
    first, *names = _split_line(cells, lines[names_at].rstrip())
    names = names if first.lower().endswith("time") else names[1:]
    below = [k for k in written if k > names_at]
    start = next((k for k in below[:2] if _has_numbers(lines[k])), len(lines))
    # Rows may have tabs below names with blanks, or blanks below names with tabs.
    first_row = "".join(lines[start : start + 1])
    return TRCHead(facts, names, names_at, start, _find_splitter(first_row, ["\t", *separators]))


def _names_markers(line: str) -> bool:
    return line.lstrip(' "').lower().startswith("frame")


def _has_numbers(line: str) -> bool:
    return any(map(looks_numeric, re.split(r"[\s;,]+", line)))


def _find_splitter(line: str, separators: Iterable[str]) -> CellSplitter:
    """Return what separates the cells of a line: the first of the separators, else blanks."""
    found = next((separator for separator in separators if separator in line), None)
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
