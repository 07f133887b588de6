"""Tables in Markdown, each below its caption."""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.reports.markdown import escape, markup_lines
from mocapbench.reports.tables.base import Cell, Table

__all__ = ["table_markdown"]


def table_markdown(table: Table) -> str:
    """Return a table with its caption above and its notes below."""
    heads = [*map(_head, table.columns)]
    rows = [[_head(row[0]), *map(_cell, row[1:])] for row in table.rows]
    notes = escape(" ".join(table.notes))
    return "\n".join([escape(table.caption), "", *markup_lines(heads, rows), "", notes, ""])


def _head(cell: Cell) -> str:
    note = f" ({cell.note})" if cell.note else ""
    return escape(f"{cell.text}{cell.mark}{note}")


def _cell(cell: Cell) -> str:
    mean = f"**{cell.text}**" if cell.kind == "best" else cell.text
    words: Sequence[str] = [mean, f"± {cell.spread}" if cell.spread else "", escape(cell.mark)]
    return " ".join(filter(None, words))
