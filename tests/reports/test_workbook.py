"""A workbook is read back as the table, says no time, and holds no formula."""

import time
from datetime import datetime
from io import BytesIO

import numpy as np
import openpyxl
import pandas as pd

from mocapbench.reports.workbook import xlsx_bytes

TABLE = pd.DataFrame(
    {
        "label": ["=1+1", "+a", "a\x1b[31m", "é – ±"],
        "mean": [0.1 + 0.2, 1e-300, np.nan, -2.0],
        "n": [1, 2, 3, 2**40],
    }
)


def test_numbers_are_numbers_to_16_digits_and_gaps_are_empty():
    again = pd.read_excel(BytesIO(xlsx_bytes(TABLE, "means")), sheet_name="means")
    pd.testing.assert_frame_equal(again[["mean", "n"]], TABLE[["mean", "n"]], rtol=1e-15)


def test_text_stays_text_and_is_nothing_but_text():
    sheet = openpyxl.load_workbook(BytesIO(xlsx_bytes(TABLE, "means"))).active
    cells = [row[0] for row in sheet.iter_rows(min_row=2)]
    assert [cell.value for cell in cells] == ["=1+1", "+a", "a", "é – ±"]
    assert {cell.data_type for cell in cells} == {"s"}


def test_the_same_table_gives_the_same_bytes_at_any_time(monkeypatch):
    first = xlsx_bytes(TABLE, "means")
    time.sleep(2.1)  # archives tell times to two seconds
    assert xlsx_bytes(TABLE, "means") == first
    about = openpyxl.load_workbook(BytesIO(first)).properties
    assert about.created == about.modified == datetime(1980, 1, 1)
