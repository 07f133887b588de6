"""Model against model over a task's cases: every pair's difference and interval."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations

import numpy as np

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.cells import Cells, cells
from mocapbench.reports.analysis.contrasts import PairContrast, contrasts
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings
from mocapbench.reports.text import decimals, number, slug

__all__ = ["contrast_table"]

Contrasts = Mapping[tuple[str, str], PairContrast]
"""By the two labels, in either order."""


def contrast_table(results: TaskResults, metric: str) -> Table | None:
    """Return the matrix of all pairs of complete competitors; None where units are too few.

    All of its pairs are over the same units. The notes name the incomplete ones.
    """
    scored = cells(results, metric)
    if not scored.labels:
        return None
    labels = [scored.labels[row] for row in np.flatnonzero(scored.complete)]
    by_pair = contrasts(scored)
    pairs = [by_pair[pair] for pair in combinations(labels, 2)]
    if not pairs or not pairs[0].tested:
        return None
    places = decimals(pair.advantage for pair in pairs)
    return Table(
        id=slug(results.layout.name, metric, "contrasts"),
        caption=f"{results.metrics[metric].short}, model against model: by how much the row is "
        f"better than the column, over {format_count(pairs[0].n, scored.unit)}",
        columns=headings(["entrant", *(f"than {label}" for label in labels)], "contrast"),
        rows=tuple(
            (Cell(row), *(_cell(by_pair.get((row, column)), places) for column in labels))
            for row in labels
        ),
        notes=_left_out(scored),
    )


def _left_out(scored: Cells) -> tuple[str, ...]:
    of_best = scored.scored[scored.best]
    named = [
        f"{label} ({(own & of_best).sum()} of {of_best.sum()} folds)"
        for label, own, complete in zip(scored.labels, scored.scored, scored.complete, strict=True)
        if not complete
    ]
    return (f"Left out, as they are incomplete: {', '.join(named)}.",) if named else ()


def _cell(contrast: PairContrast | None, places: int) -> Cell:
    if contrast is None:
        return ABSENT
    low, high = (number(bound, places) for bound in (contrast.low, contrast.high))
    side = "ahead" if contrast.advantage > 0.0 else "behind"
    return Cell(
        number(contrast.advantage, places),
        note=_join_with_hard_spaces(f"{low} to {high}"),
        kind=f"contrast {side}" if contrast.separable else "contrast",
    )


def _join_with_hard_spaces(text: str) -> str:
    return text.replace(" ", "\N{NO-BREAK SPACE}")
