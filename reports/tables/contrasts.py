"""Model against model over a task's cases: every pair's difference, interval and probabilities."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import pandas as pd

from mocapbench.metrics.statistics import (
    ALPHA,
    Contrast,
    contrast,
    holm,
    least_signed_rank_p,
    pair,
    pooled_units,
)
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.tables.base import ABSENT, Cell, Table, decimals, headings, number, slug

__all__ = ["Corrected", "contrast_table", "corrected", "pooled_contrast"]


@dataclass(frozen=True)
class Corrected:
    """A contrast and its p-value by the paired t-test, corrected over a family."""

    contrast: Contrast
    p: float

    @property
    def separable(self) -> bool:
        """Whether the difference is more than chance; never without a test."""
        return self.p <= ALPHA


def corrected(contrasts: Sequence[Contrast]) -> list[Corrected]:
    """Correct a family of contrasts after Holm."""
    p_values = holm([each.t_p for each in contrasts])
    return [Corrected(each, float(p)) for each, p in zip(contrasts, p_values, strict=True)]


def pooled_contrast(results: TaskResults, metric: str, first: str, second: str) -> Contrast:
    """Return the contrast of two labels over the judged cases: see `pooled_units`."""
    judged = [case.name for case in results.judged(metric)]
    values = results.values[metric]
    values = values[values.index.get_level_values("case").isin(judged)]
    units = pooled_units(
        pair(values[first], values[second]), independent=results.layout.independent_folds
    )
    return contrast(units, results.metrics[metric].loss)


def contrast_table(results: TaskResults, metric: str) -> Table | None:
    """Return the matrix of all pairs of competitors; None where no pair has two units."""
    scored = {label for _, label, name in results.estimates if name == metric}
    labels = [label for label in results.layout.ranked if label in scored]
    pairs = list(combinations(labels, 2))
    found = corrected([pooled_contrast(results, metric, *each) for each in pairs])
    by_pair = dict(zip(pairs, found, strict=True))
    most = max((each.contrast.n for each in found), default=0)
    if most < 2:
        return None
    places = decimals(e.contrast.advantage for e in found if math.isfinite(e.contrast.advantage))
    title = results.metrics[metric].title
    return Table(
        id=slug(results.layout.name, metric, "contrasts"),
        caption=f"{title}, model against model: by how much the row is better than the column",
        columns=headings(["entrant", *(f"than {label}" for label in labels)], "contrast"),
        rows=tuple(
            (Cell(one), *(_cell(by_pair, one, other, places) for other in labels)) for one in labels
        ),
        data=_tidy(results, metric, by_pair),
        notes=_notes(results, metric, most),
    )


def _cell(pairs: Mapping[tuple[str, str], Corrected], one: str, other: str, places: int) -> Cell:
    if (one, other) in pairs:
        return _shown(pairs[one, other], 1.0, places)
    return _shown(pairs[other, one], -1.0, places) if (other, one) in pairs else ABSENT


def _shown(found: Corrected, sign: float, places: int) -> Cell:
    """Return the cell of a contrast, seen from its first side (1) or its second (−1)."""
    seen = found.contrast
    if seen.n < 2:
        return ABSENT
    low, high = sorted((sign * seen.low, sign * seen.high))
    better, worse = (seen.better, seen.worse)[:: int(sign)]
    shares = _unbroken(f"{better:.0%} / {seen.equivalent:.0%} / {worse:.0%}")
    side = "ahead" if sign * seen.advantage > 0.0 else "behind"
    return Cell(
        number(sign * seen.advantage, places),
        note=f"{_unbroken(f'{number(low, places)} to {number(high, places)}')}; {shares}",
        kind=f"contrast {side}" if found.separable else "contrast",
    )


def _unbroken(text: str) -> str:
    return text.replace(" ", "\N{NO-BREAK SPACE}")


def _notes(results: TaskResults, metric: str, most: int) -> tuple[str, ...]:
    n_cases = len(results.judged(metric))
    unit = "cases, each the mean of its folds" if n_cases > 1 else "folds of the only case"
    floor = least_signed_rank_p(most)
    return (
        f"Below each difference: its 95 % interval (Student’s t over {most} {unit}), and the "
        "probabilities that the row is better, equivalent within 2 %, or worse than the column "
        "(Bayesian correlated t-test).",
        "▲ ahead, ▼ behind: more than chance by the paired t-test with Holm’s correction over all "
        "pairs, 5 %. No mark: the two share a rank.",
        *(
            [
                f"Wilcoxon’s signed-rank test, in the CSV, cannot go below p = {floor:.4g} with "
                f"{most} units, so it is no guide here."
            ]
            if floor > ALPHA
            else []
        ),
    )


def _tidy(
    results: TaskResults, metric: str, pairs: Mapping[tuple[str, str], Corrected]
) -> pd.DataFrame:
    signed_ranks = holm([each.contrast.signed_rank_p for each in pairs.values()])
    return pd.DataFrame(
        [
            {
                "task": results.layout.name,
                "metric": metric,
                "first_label": one,
                "second_label": other,
                **vars(found.contrast),
                "t_p_holm": found.p,
                "signed_rank_p_holm": signed,
            }
            for ((one, other), found), signed in zip(pairs.items(), signed_ranks, strict=True)
        ]
    )
