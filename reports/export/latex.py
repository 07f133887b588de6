r"""Tables in LaTeX with the package booktabs, and figures: what ``\input`` takes.

A mean and its interval are two columns, so that decimal points stand below each other.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import groupby, zip_longest

from mocapbench.basics.words import printable
from mocapbench.reports.export.page_width import wrap_head
from mocapbench.reports.tables.base import Cell, Table
from mocapbench.reports.text import MINUS

__all__ = ["escape_latex", "figure_latex", "table_latex"]

_MARKS = {"": "", "†": r"^{\dagger}", "‡": r"^{\ddagger}", "*": r"^{\ast}"}
_MATHS = {
    **{"<": "<", ">": ">", "|": "|", "*": r"\ast", MINUS: "-", "±": r"\pm", "×": r"\times"},
    **{"≤": r"\le", "≥": r"\ge", "≈": r"\approx", "·": r"\cdot", "°": r"^{\circ}"},
    **{"†": r"\dagger", "‡": r"\ddagger", "²": "^2", "³": "^3", "→": r"\to", "∞": r"\infty"},
    "§": r"\mathsection",  # of the fonts of formulas, which every TeX has as outlines
}
_MARKUP = str.maketrans(
    {
        **{character: f"\\{character}" for character in "{}$&#_%"},
        **{character: f"${command}$" for character, command in _MATHS.items()},
        "\\": r"\textbackslash{}",
        "~": r"\textasciitilde{}",
        "^": r"\textasciicircum{}",
    }
)
_WITHIN_LIGATURES = re.compile(r"(?<=[-'`,?!])(?=[-'`,])")
"""Where LaTeX would join two characters, as two hyphens to a dash."""


def escape_latex(text: str) -> str:
    r"""Return ``text`` as LaTeX that shows it, without any markup of its own.

    Examples
    --------
    >>> escape_latex("50_% & more")
    '50\\_\\% \\& more'
    """
    line = " ".join(printable(text).split())
    return _WITHIN_LIGATURES.sub("{}", line.translate(_MARKUP))


def figure_latex(file: str, caption: str, name: str) -> str:
    r"""Return a figure for ``\input`` that shows a file.

    Parameters
    ----------
    file : str
        Its name, by which LaTeX finds it.
    caption : str
    name : str
        The label is ``fig:`` and this.
    """
    return "\n".join(
        [
            r"\begin{figure}",
            r"  \centering",
            rf"  \includegraphics{{{file}}}",
            rf"  \caption{{{escape_latex(caption)}}}",
            rf"  \label{{fig:{name}}}",
            r"\end{figure}",
            "",
        ]
    )


def table_latex(table: Table) -> str:
    """Return a table as a floating one, with its caption and label."""
    n_columns = len(table.columns) - 1
    groups = groupby(table.rows, key=lambda row: row[0].kind)
    blocks = ["\n".join(map(_row, rows)) for _, rows in groups]
    lines = [
        r"\begin{table}[htbp]",
        r"\centering",
        rf"\caption{{{escape_latex(' '.join([table.caption, *table.notes]))}}}",
        rf"\label{{tab:{table.id}}}",
        r"\smallskip",
        r"\small",
        rf"\begin{{tabular}}{{l{'r@{}l' * n_columns}}}",
        r"\toprule",
        *_head_lines(table),
        r"\midrule",
        "\n\\midrule\n".join(blocks),
        r"\bottomrule",
        r"\end{tabular}",
        r"\end{table}",
    ]
    return "\n".join([*lines, ""])


def _head_lines(table: Table) -> Iterator[str]:
    """Yield the lines of the heads, of which the last ones stand at the bottom."""
    first, *others = table.columns
    columns = [[row[place] for row in table.rows] for place in range(1, len(table.columns))]
    wrapped = [
        [*map(escape_latex, wrap_head(head, cells))]
        for head, cells in zip(others, columns, strict=True)
    ]
    for lines, head in zip(wrapped, others, strict=True):
        lines[-1] += _raise(head)
    upwards = [*zip_longest(*(lines[::-1] for lines in wrapped), fillvalue="")]
    for n, line in reversed([*enumerate(upwards)]):
        cells = (rf"\multicolumn{{2}}{{c}}{{{text}}}" for text in line)
        yield " & ".join([escape_latex(first.text) if n == 0 else "", *cells]) + r" \\"


def _row(row: Sequence[Cell]) -> str:
    head, *cells = row
    note = f" ({escape_latex(head.note)})" if head.note else ""
    return " & ".join([escape_latex(head.text) + _raise(head) + note, *map(_cell, cells)]) + r" \\"


def _cell(cell: Cell) -> str:
    if cell.value is None:
        return r"\multicolumn{2}{c}{--}"
    mean = cell.text.replace(MINUS, "-")
    shown = rf"\mathbf{{{mean}}}" if cell.kind == "best" else mean
    spread = rf"{{}}\pm {cell.spread}" if cell.spread else "{}"
    right = f" ${spread}{_MARKS[cell.mark]}$" if cell.spread or cell.mark else ""
    return f"${shown}$ &{right}"


def _raise(cell: Cell) -> str:
    return f"${_MARKS[cell.mark]}$" if cell.mark else ""
