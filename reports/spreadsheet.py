"""CSV that spreadsheets open as data: no text in it begins a formula, or hides what it is.

A program that opens a CSV file takes a cell for a formula if it begins with one of a few
characters, and a formula may call other programs. An apostrophe before them makes it text.
Control characters and marks of direction are left out, as in a terminal.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any

import numpy as np
import pandas as pd

from mocapbench.basics.words import printable

__all__ = ["csv_text", "guard_text", "unguard_text"]

# Text that begins with apostrophes before such a character gets one more, so that no two texts
# become one.
_BEGINS_FORMULA = r"(?='*[-=+@\t\r\n＝＋－＠])"
_UNGUARDED = re.compile(rf"\A{_BEGINS_FORMULA}")
_GUARDED = re.compile(rf"\A'{_BEGINS_FORMULA}")
_LINE_END = re.compile(r"\r\n?")


def csv_text(frame: pd.DataFrame) -> str:
    """Return a table as CSV, unrounded, its text guarded and its numbers as they are.

    Parameters
    ----------
    frame : DataFrame
    """
    text = frame.select_dtypes(exclude=["number", "bool"])
    safe = frame.assign(**{str(name): _column(cells) for name, cells in text.items()})
    return str(safe.rename(columns=_cell).to_csv(index=False, lineterminator="\n"))


def guard_text(text: str) -> str:
    """Return ``text``, with an apostrophe before it if it would begin a formula."""
    return _UNGUARDED.sub("'", text)


def unguard_text(text: str) -> str:
    """Return what `guard_text` was given."""
    return _GUARDED.sub("", text)


def _column(cells: pd.Series[Any]) -> pd.Series[Any]:
    """Return cells that keep their types: a column of integers and gaps gets no decimals."""
    if isinstance(cells.dtype, pd.CategoricalDtype):  # of few texts and many cells
        texts = np.array([*map(_cell, cells.cat.categories), None], dtype=object)
        return pd.Series(texts[cells.cat.codes], cells.index, dtype=object)
    return pd.Series([*map(_cell, cells)], cells.index, dtype=object)


def _cell(value: Any) -> Any:
    match value:
        case str():
            return _guard_line(value)
        case _:
            return value


@lru_cache(maxsize=4096)  # of hundreds of thousands of rows most have the same texts
def _guard_line(text: str) -> str:
    # A carriage return, which writers leave unquoted, would begin a row.
    return guard_text(printable(_LINE_END.sub("\n", text)))
