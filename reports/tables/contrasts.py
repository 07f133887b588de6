"""Model against model over a task's cases: every pair's difference and interval."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import combinations

from mocapbench.metrics.statistics import FEWEST_UNITS
from mocapbench.reports.analysis.cells import cells
from mocapbench.reports.analysis.contrasts import PairContrast, contrasts
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings
from mocapbench.reports.text import counted, decimals, number, slug

__all__ = ["contrast_table"]

Contrasts = Mapping[tuple[str, str], PairContrast]
"""By the two labels, in either order."""


def contrast_table(results: TaskResults, metric: str) -> Table | None:
    """Return the matrix of all pairs of competitors; None where no pair has enough units."""
    scored = cells(results, metric)
    by_pair = contrasts(scored)
    most = max((contrast.n for contrast in by_pair.values()), default=0)
    if most < FEWEST_UNITS:
        return None
    advantages = [by_pair[pair].advantage for pair in combinations(scored.labels, 2)]
    places = decimals(value for value in advantages if not math.isnan(value))
    title = results.metrics[metric].short
    return Table(
        id=slug(results.layout.name, metric, "contrasts"),
        caption=f"{title}, model against model: by how much the row is better than the column, "
        f"over {counted(most, scored.unit)}",
        columns=headings(["entrant", *(f"than {label}" for label in scored.labels)], "contrast"),
        rows=tuple(
            (Cell(row), *(_cell(by_pair.get((row, column)), places) for column in scored.labels))
            for row in scored.labels
        ),
    )


def _cell(contrast: PairContrast | None, places: int) -> Cell:
    if contrast is None or not contrast.tested:
        return ABSENT
    low, high = (number(bound, places) for bound in (contrast.low, contrast.high))
    side = "ahead" if contrast.advantage > 0.0 else "behind"
    return Cell(
        number(contrast.advantage, places),
        note=_unbroken(f"{low} to {high}"),
        kind=f"contrast {side}" if contrast.separable else "contrast",
    )


def _unbroken(text: str) -> str:
    return text.replace(" ", "\N{NO-BREAK SPACE}")
