"""Plain tables as values, so that one template renders all of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

__all__ = ["ABSENT", "Cell", "Table", "headings"]


@dataclass(frozen=True)
class Cell:
    """One cell of a table.

    Parameters
    ----------
    text : str
    spread : str
        The number after ±, without the sign.
    note : str
        A small line below.
    mark : str
        The letter of a footnote.
    kind : str
        ``""``, ``"best"``, ``"tied"``, ``"text"``, ``"absent"``, ``"failure"``,
        ``"published"``, ``"contrast"``, ``"contrast ahead"``, ``"contrast behind"`` or a verdict:
        the cell's class in the style sheet.
    link : str
        Id of the place on the page that explains the text.
    value : float or None
        The number in full, by which rows are sorted.
    """

    text: str
    spread: str = ""
    note: str = ""
    mark: str = ""
    kind: str = ""
    link: str = ""
    value: float | None = None


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
    notes : tuple of str
        Notes below the table.
    """

    id: str
    caption: str
    columns: tuple[Cell, ...]
    rows: tuple[tuple[Cell, ...], ...]
    notes: tuple[str, ...] = ()


def headings(names: Sequence[str], kind: str = "") -> tuple[Cell, ...]:
    """Return one column heading per name."""
    return tuple(Cell(name, kind=kind) for name in names)
