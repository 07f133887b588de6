"""A table as a workbook of Excel: numbers as numbers, text as text, the same bytes each time."""

from __future__ import annotations

import re
from collections.abc import Iterator
from datetime import UTC, datetime
from io import BytesIO
from math import isnan
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

import pandas as pd
from openpyxl import Workbook
from openpyxl.cell import WriteOnlyCell

from mocapbench.basics.words import printable

__all__ = ["xlsx_bytes"]

_PROPERTIES = "docProps/core.xml"
_EARLIEST = datetime(1980, 1, 1, tzinfo=UTC)
"""The first time that an archive can tell."""


def xlsx_bytes(frame: pd.DataFrame, title: str) -> bytes:
    """Return a table as the only sheet of a workbook, to 16 digits; what is NaN is an empty cell.

    Parameters
    ----------
    frame : DataFrame
    title : str
        Of the sheet.
    """
    book = Workbook(write_only=True)
    sheet = book.create_sheet(title)
    sheet.freeze_panes = "A2"
    sheet.append([*map(str, frame.columns)])
    for row in frame.astype(object).itertuples(index=False):
        sheet.append([*_fill_cells(sheet, row)])
    saved = BytesIO()
    book.save(saved)
    return _drop_times(saved.getvalue())


def _fill_cells(sheet: Any, row: tuple[Any, ...]) -> Iterator[Any]:
    """Yield the cells of a row. Text that begins like a formula stays text."""
    for value in row:
        match value:
            case str():
                cell = WriteOnlyCell(sheet, printable(value))
                cell.data_type = "s"
                yield cell
            case float() if isnan(value):
                yield None
            case _:
                yield value


def _drop_times(archive: bytes) -> bytes:
    """Return a workbook that does not say when it was made."""
    made, dated = BytesIO(), re.compile(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ")
    with ZipFile(BytesIO(archive)) as given, ZipFile(made, "w", ZIP_DEFLATED) as kept:
        for name in given.namelist():
            content = given.read(name)
            if name == _PROPERTIES:
                content = dated.sub(f"{_EARLIEST:%Y-%m-%dT%H:%M:%SZ}".encode(), content)
            kept.writestr(ZipInfo(name, _EARLIEST.timetuple()[:6]), content, ZIP_DEFLATED)
    return made.getvalue()
