"""Markdown in which names and messages read as they are written."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from mocapbench.basics.words import printable

__all__ = ["escape", "markup_lines", "table_lines"]

_MARKUP = str.maketrans(
    {
        **{character: f"\\{character}" for character in r"\`*_[]|~#$"},
        # Not every reader takes a backslash before these, as it takes the entities of HTML.
        **{"&": "&amp;", "<": "&lt;", ">": "&gt;"},
    }
)


def escape(text: str) -> str:
    r"""Return ``text`` as one line of Markdown that shows it, without any markup of its own.

    It is to stand within a line or a cell of a table.

    Examples
    --------
    >>> escape("gp_independent: <b>|x|</b>")
    'gp\\_independent: &lt;b&gt;\\|x\\|&lt;/b&gt;'
    """
    return " ".join(printable(text).split()).translate(_MARKUP)


def table_lines(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """Return the lines of a table whose cells show the texts they are given."""
    return markup_lines([*map(escape, columns)], [[*map(escape, row)] for row in rows])


def markup_lines(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """Return the lines of a table whose cells are Markdown already."""
    return [_line(columns), _line(["---"] * len(columns)), *map(_line, rows)]


def _line(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |"
