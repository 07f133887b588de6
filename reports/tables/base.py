"""Tables as values: cells of text for people, and a tidy frame of full precision for machines.

Every table of the page is a `Table`, whatever it shows, so that one template renders it and one
function each turns it into CSV and LaTeX.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

__all__ = ["ABSENT", "Cell", "Table", "counted", "decimals", "headings", "number", "slug"]

MINUS = "\N{MINUS SIGN}"


@dataclass(frozen=True)
class Cell:
    """One cell of a table.

    Parameters
    ----------
    text : str
    spread : str
        The ± behind the text, without its sign.
    note : str
        A small line below.
    mark : str
        The letter of a footnote.
    kind : str
        ``""``, ``"best"``, ``"text"``, ``"absent"``, ``"trouble"``, ``"published"`` or a verdict.
    link : str
        Id of the place on the page that explains the note, or the text where there is no note.
    span : int
        Number of columns that it takes.
    """

    text: str
    spread: str = ""
    note: str = ""
    mark: str = ""
    kind: str = ""
    link: str = ""
    span: int = 1


ABSENT = Cell("–", kind="absent")


@dataclass(frozen=True, eq=False)
class Table:
    """A table of the page.

    Parameters
    ----------
    id : str
        Unique on the page.
    caption : str
    columns : tuple of Cell
        Column headings.
    rows : tuple of tuple of Cell
        The first cell of a row is its heading.
    data : DataFrame
        The same content, tidy and unrounded.
    notes : tuple of str
        Footnotes.
    """

    id: str
    caption: str
    columns: tuple[Cell, ...]
    rows: tuple[tuple[Cell, ...], ...]
    data: pd.DataFrame
    notes: tuple[str, ...] = ()


def slug(*names: str) -> str:
    """Return an id made of letters, digits and hyphens."""
    characters = "-".join(names).lower()
    return "".join(c if c.isascii() and c.isalnum() else "-" for c in characters)


def decimals(values: Iterable[float]) -> int:
    """Return how many decimals (2 to 4) show the small ones of ``values`` to two digits.

    One value in ten may be smaller still: a single number near zero must not widen a table.
    """
    sizes = np.abs(np.array([value for value in values if value != 0.0]))
    if not sizes.size:
        return 2
    return int(np.clip(1 - np.floor(np.log10(np.quantile(sizes, 0.1))), 2, 4))


def number(value: float, places: int) -> str:
    """Return ``value`` with ``places`` decimals, a true minus sign, and no negative zero."""
    return f"{value:z.{places}f}".replace("-", MINUS)


def counted(count: int, noun: str) -> str:
    """Return "1 case", "2 cases": the count and the noun in the form that it takes."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def headings(names: Sequence[str], kind: str = "") -> tuple[Cell, ...]:
    """Return one column heading per name."""
    return tuple(Cell(name, kind=kind) for name in names)
