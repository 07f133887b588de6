"""Every table as CSV, for machines, and as LaTeX, for papers."""

from __future__ import annotations

import pandas as pd

from mocapbench.reports.printable import printable
from mocapbench.reports.spreadsheet import csv_text
from mocapbench.reports.tables.base import Cell, Table
from mocapbench.reports.text import MINUS

__all__ = ["to_csv", "to_latex"]

LATEX = str.maketrans(
    {
        **{character: f"\\{character}" for character in "&%$#_{}"},
        "\\": r"\textbackslash{}",
        "~": r"\textasciitilde{}",
        "^": r"\textasciicircum{}",
        **{"<": "$<$", ">": "$>$", "|": r"\textbar{}"},
        "±": r"$\pm$",
        "×": r"$\times$",
        MINUS: "$-$",
        "–": "--",
        "’": "'",
    }
)


def to_csv(table: Table) -> str:
    """Return the tidy, unrounded data of ``table``."""
    return csv_text(table.data)


def to_latex(table: Table) -> str:
    """Return ``table`` as it is shown, without the notes of its cells, for booktabs."""
    frame = pd.DataFrame(
        [[text for cell in row for text in _columns(cell)] for row in table.rows],
        columns=[_latex(cell) for cell in table.columns],
    )
    alignment = "l" + "r" * (len(table.columns) - 1)
    return str(frame.to_latex(index=False, escape=False, column_format=alignment))


def _columns(cell: Cell) -> list[str]:
    return [_latex(cell), *[""] * (cell.span - 1)]


def _latex(cell: Cell) -> str:
    text = _escaped(f"{cell.text} ± {cell.spread}" if cell.spread else cell.text)
    text += rf"\textsuperscript{{{cell.mark}}}" if cell.mark else ""
    return rf"\textbf{{{text}}}" if cell.kind == "best" else text


def _escaped(text: str) -> str:
    """Return ``text`` as one line that shows it."""
    line = " ".join(printable(text).split()).translate(LATEX)
    return f"{{}}{line}" if line[:1] in {"[", "*"} else line  # else an argument of the row before
