"""Findings of a recording: a table with a row for each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pandas as pd

__all__ = ["COLUMNS", "tabulate_findings", "unite_findings"]

COLUMNS = ("kind", "markers", "start", "stop", "size")
"""What it is, of which markers, in which frames [start, stop), and how large in their unit."""


def tabulate_findings(rows: Sequence[Sequence[Any]]) -> pd.DataFrame:
    """Return findings as a table, in the order of frames."""
    table = pd.DataFrame(list(rows), columns=list(COLUMNS))
    return table.sort_values(["start", "stop", "kind"], kind="stable", ignore_index=True)


def unite_findings(*tables: pd.DataFrame) -> pd.DataFrame:
    """Return the findings of all tables, in the order of frames."""
    return tabulate_findings(
        [row for table in tables for row in table.itertuples(index=False, name=None)]
    )
