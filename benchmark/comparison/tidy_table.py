"""A comparison for programs: one line per contrast, unrounded."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict

import pandas as pd

from mocapbench.benchmark.comparison.printing import outcome
from mocapbench.benchmark.comparison.rows import Row

__all__ = ["tidy"]


def tidy(rows: Iterable[Row], sides: tuple[str, str]) -> pd.DataFrame:
    """Return one line per contrast, unrounded, with its outcome in words."""
    lines = []
    for row in rows:
        line = asdict(row)
        own = {name: value for name, value in line.items() if name != "contrast"}
        lines.append({**own, **line["contrast"], "outcome": outcome(row, sides)})
    return pd.DataFrame(lines)
