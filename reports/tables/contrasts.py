"""Model against model over a task's cases: every pair's difference, interval and probabilities."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import combinations

import pandas as pd

from mocapbench.metrics.statistics import ALPHA, holm, least_signed_rank_p
from mocapbench.reports.analysis.contrasts import (
    CorrectedContrast,
    corrected_contrasts,
    pooled_contrast,
)
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings
from mocapbench.reports.text import decimals, number, slug

__all__ = ["contrast_table"]

Contrasts = Mapping[tuple[str, str], CorrectedContrast]
"""By the two labels, first and second."""


def contrast_table(results: TaskResults, metric: str) -> Table | None:
    """Return the matrix of all pairs of competitors; None where no pair has two units."""
    scored = {label for _, label, name in results.estimates if name == metric}
    labels = [label for label in results.layout.ranked if label in scored]
    pairs = list(combinations(labels, 2))
    family = corrected_contrasts([pooled_contrast(results, metric, *pair) for pair in pairs])
    contrasts = dict(zip(pairs, family, strict=True))
    most = max((corrected.contrast.n for corrected in family), default=0)
    if most < 2:
        return None
    places = _places(contrasts)
    title = results.metrics[metric].title
    return Table(
        id=slug(results.layout.name, metric, "contrasts"),
        caption=f"{title}, model against model: by how much the row is better than the column",
        columns=headings(["entrant", *(f"than {label}" for label in labels)], "contrast"),
        rows=tuple(
            (Cell(row), *(_cell(contrasts, row, column, places) for column in labels))
            for row in labels
        ),
        data=_tidy(results, metric, contrasts),
        notes=_notes(results, metric, most),
    )


def _places(contrasts: Contrasts) -> int:
    advantages = [corrected.contrast.advantage for corrected in contrasts.values()]
    return decimals(advantage for advantage in advantages if math.isfinite(advantage))


def _cell(contrasts: Contrasts, row: str, column: str, places: int) -> Cell:
    if (row, column) in contrasts:
        return _contrast_cell(contrasts[row, column], 1.0, places)
    if (column, row) in contrasts:
        return _contrast_cell(contrasts[column, row], -1.0, places)
    return ABSENT


def _contrast_cell(corrected: CorrectedContrast, sign: float, places: int) -> Cell:
    """Return the cell of a contrast, seen from its first label (1) or its second (−1)."""
    contrast = corrected.contrast
    if contrast.n < 2:
        return ABSENT
    low, high = sorted((sign * contrast.low, sign * contrast.high))
    better, worse = (contrast.better, contrast.worse)[:: int(sign)]
    shares = _unbroken(f"{better:.0%} / {contrast.equivalent:.0%} / {worse:.0%}")
    side = "ahead" if sign * contrast.advantage > 0.0 else "behind"
    return Cell(
        number(sign * contrast.advantage, places),
        note=f"{_unbroken(f'{number(low, places)} to {number(high, places)}')}; {shares}",
        kind=f"contrast {side}" if corrected.separable else "contrast",
    )


def _unbroken(text: str) -> str:
    return text.replace(" ", "\N{NO-BREAK SPACE}")


def _notes(results: TaskResults, metric: str, most: int) -> tuple[str, ...]:
    n_cases = len(results.representative_cases(metric))
    unit = "cases, each the mean of its folds" if n_cases > 1 else "folds of the only case"
    floor = least_signed_rank_p(most)
    powerless = (
        f"Wilcoxon’s signed-rank test, in the CSV, cannot go below p = {floor:.4g} with "
        f"{most} units, so it cannot reach significance here."
    )
    return (
        f"Below each difference: its 95 % interval (Student’s t over {most} {unit}), and the "
        "probabilities that the row is better, equivalent within 2 %, or worse than the column "
        "(Bayesian correlated t-test).",
        "▲ ahead, ▼ behind: more than chance by the paired t-test with Holm’s correction over all "
        "pairs, 5 %. No mark: the two share a rank.",
        *([powerless] if floor > ALPHA else []),
    )


def _tidy(results: TaskResults, metric: str, contrasts: Contrasts) -> pd.DataFrame:
    signed_ranks = holm([corrected.contrast.signed_rank_p for corrected in contrasts.values()])
    return pd.DataFrame(
        [
            {
                "task": results.layout.name,
                "metric": metric,
                "first_label": first,
                "second_label": second,
                **vars(corrected.contrast),
                "t_p_holm": corrected.p,
                "signed_rank_p_holm": signed_rank_p,
            }
            for ((first, second), corrected), signed_rank_p in zip(
                contrasts.items(), signed_ranks, strict=True
            )
        ]
    )
