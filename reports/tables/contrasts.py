"""Model against model over a task's cases: every pair's difference, interval and probabilities."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import combinations

import pandas as pd

from mocapbench.reports.analysis.cells import cells
from mocapbench.reports.analysis.contrasts import PairContrast, contrasts
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.units import FEWEST_UNITS
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings
from mocapbench.reports.text import counted, decimals, number, slug

__all__ = ["contrast_table"]

Contrasts = Mapping[tuple[str, str], PairContrast]
"""By the two labels, first and second."""


def contrast_table(results: TaskResults, metric: str) -> Table | None:
    """Return the matrix of all pairs of competitors; None where no pair has enough units."""
    scored = cells(results, metric)
    pairs = list(combinations(scored.labels, 2))
    by_pair = dict(zip(pairs, contrasts(scored, pairs), strict=True))
    most = max((contrast.n for contrast in by_pair.values()), default=0)
    if most < FEWEST_UNITS:
        return None
    places = decimals(c.advantage for c in by_pair.values() if math.isfinite(c.advantage))
    title = results.metrics[metric].title
    return Table(
        id=slug(results.layout.name, metric, "contrasts"),
        caption=f"{title}, model against model: by how much the row is better than the column, "
        f"over {counted(most, scored.unit)}",
        columns=headings(["entrant", *(f"than {label}" for label in scored.labels)], "contrast"),
        rows=tuple(
            (Cell(row), *(_cell(by_pair, row, column, places) for column in scored.labels))
            for row in scored.labels
        ),
        data=_tidy(results, metric, by_pair),
    )


def _cell(contrasts: Contrasts, row: str, column: str, places: int) -> Cell:
    if (row, column) in contrasts:
        return _contrast_cell(contrasts[row, column], 1.0, places)
    if (column, row) in contrasts:
        return _contrast_cell(contrasts[column, row], -1.0, places)
    return ABSENT


def _contrast_cell(contrast: PairContrast, sign: float, places: int) -> Cell:
    """Return the cell of a contrast, seen from its first label (1) or its second (−1)."""
    if not contrast.tested:
        return ABSENT
    low, high = sorted((sign * contrast.low, sign * contrast.high))
    better, worse = (contrast.better, contrast.worse)[:: int(sign)]
    shares = _unbroken(f"{better:.0%} / {contrast.equivalent:.0%} / {worse:.0%}")
    side = "ahead" if sign * contrast.advantage > 0.0 else "behind"
    return Cell(
        number(sign * contrast.advantage, places),
        note=f"{_unbroken(f'{number(low, places)} to {number(high, places)}')}; {shares}",
        kind=f"contrast {side}" if contrast.separable else "contrast",
    )


def _unbroken(text: str) -> str:
    return text.replace(" ", "\N{NO-BREAK SPACE}")


def _tidy(results: TaskResults, metric: str, by_pair: Contrasts) -> pd.DataFrame:
    return pd.DataFrame(
        [
            {
                "task": results.layout.name,
                "metric": metric,
                "first_label": first,
                "second_label": second,
                **vars(contrast),
            }
            for (first, second), contrast in by_pair.items()
        ]
    )
