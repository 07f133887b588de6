"""The first line of a file of separated values, and the causes why it may not name the columns."""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.tables.notation import notation_of
from mocapbench.datasets.formats.text.cells import CellSplitter
from mocapbench.datasets.formats.text.numbers import is_missing, looks_numeric

__all__ = ["check_lines", "column_names"]

_SHOWN = 60
_LEAST = 2  # columns
_EXPECTED = "the names of the columns, with commas, semicolons or tabs between them"
_EXAMPLE = "write such as 'time,hip.x [cm],hip.y [cm]' in the first line"
_DEEPEST = 60
"""Lines among which the names of columns are sought, to say where they are."""


def check_lines(file: str, lines: Sequence[str]) -> None:
    """Refuse a file without text, and what is one line to all but old programs.

    Raises
    ------
    FormatError
        If there is no line, or a carriage return alone ends the first.
    """
    if not lines:
        raise FormatError(file, _EXPECTED, "an empty file", _EXAMPLE, line=1)
    if "\r" in lines[0].rstrip("\r\n"):
        expected, got = "lines that end with LF or CR LF", "lines that end with CR alone"
        raise FormatError(file, expected, got, "save it with other line ends", line=1)


def column_names(file: str, lines: Sequence[str], top: int, cells: CellSplitter) -> list[str]:
    """Return the names of the columns, which are in the first line.

    Parameters
    ----------
    file : str
    lines : sequence of str
    top : int
        Index of the first line.
    cells : CellSplitter

    Raises
    ------
    FormatError
        If that line has something else, or the one below has more cells than there are names.
    """
    names = [name.strip() for name in cells.split(lines[top])]
    below = cells.split(lines[top + 1]) if len(lines) > top + 1 else []
    advice = _advise_on_first_line(lines, top, names, below)
    if advice:
        raise FormatError(file, _EXPECTED, _quote_line(lines[top]), advice, top + 1)
    if cells.separator == "," and len(names) < len(below) and all(map(looks_numeric, below)):
        advice = (
            "if commas are decimal marks here, put semicolons between columns, else name every "
            "column in the first line"
        )
        got = f"{len(below)} between commas"
        raise FormatError(file, f"{len(names)} cells", got, advice, top + 2)
    return [names[0].lstrip("# "), *names[1:]]  # numpy.savetxt writes names as a comment


def _advise_on_first_line(
    lines: Sequence[str], top: int, names: Sequence[str], below: Sequence[str]
) -> str:
    """Return what to do about a first line that does not name the columns, or nothing."""
    if names[0].startswith("#") and not _are_above(names, below):
        return "remove what stands above the names of the columns"
    lower = _find_names(lines, top, len(names))
    if lower is not None:
        return (
            f"line {lower + 1} seems to name the columns, below a head of a program that is not "
            "known: remove the lines above, or export the recording as C3D or TRC"
        )
    if all(is_missing(name) or looks_numeric(name) for name in names):
        return f"export the table with its head, or {_EXAMPLE}"
    return ""


def _are_above(names: Sequence[str], below: Sequence[str]) -> bool:
    """Return whether a line has a name for each cell of the one below, which has numbers."""
    return len(names) == len(below) and any(map(looks_numeric, below))


def _find_names(lines: Sequence[str], top: int, width: int) -> int | None:
    """Return the first line that seems to name the columns, if it is not the first of all.

    It has another number of cells than the first line of all, none of them a number, and a line of
    as many cells below, most of them numbers.
    """
    for index in range(top + 1, min(top + _DEEPEST, len(lines) - 1)):
        cells, _ = notation_of(lines[index : index + 2])
        names, below = cells.split(lines[index]), cells.split(lines[index + 1])
        n_numbers = sum(map(looks_numeric, below))
        if len(names) == len(below) >= _LEAST and 2 * n_numbers > len(below):
            return None if width == len(names) or any(map(looks_numeric, names)) else index
    return None


def _quote_line(line: str) -> str:
    return repr(line[:_SHOWN].rstrip())
