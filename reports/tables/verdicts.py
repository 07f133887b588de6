"""The table of our numbers beside the published ones, with the rule of the verdicts under it."""

from __future__ import annotations

import math

import pandas as pd

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.verdicts import Comparison, allowance, comparisons
from mocapbench.reports.bundle.bundle import TaskLayout
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.paper.remarks import footnotes, marks
from mocapbench.reports.tables.base import Cell, Table, decimals, headings, number, slug

__all__ = ["verdict_table"]

ALLOWANCE = "2 % of the published value, or the ± that the paper prints where that is more"
RULES = (
    f"Reproduced: our mean lies within the allowance, {ALLOWANCE}, and half its 95 % interval over "
    "folds (Student’s t) is no wider than the allowance.",
    "Better, worse: the published value lies outside our interval widened by the allowance. "
    "Undecided: neither; the folds are too few or too noisy to tell.",
    "One fold has no interval: its verdict compares the bare value with the allowance.",
)
WINDOW_RULES = (
    f"Reproduced: our mean lies within the allowance, {ALLOWANCE}. Better, worse: it does not.",
    "The folds are overlapping windows of one recording, and the published value is a mean over "
    "all of the paper’s: the ± is the spread over the windows, and the verdict compares means "
    "only. A run of fewer windows than the paper’s averages something else.",
)


def verdict_table(results: TaskResults, metric: str) -> Table | None:
    """Return the table of ours, published, difference and verdict; None where nothing compares."""
    pairs = comparisons(results, metric)
    if not pairs:
        return None
    lettered = marks(pair.published.erratum for pair in pairs)
    places = decimals(value for pair in pairs for value in (pair.ours.mean, pair.published.value))
    return Table(
        id=slug(results.layout.name, metric, "published"),
        caption=f"{results.metrics[metric].title}: ours beside the published value",
        columns=(
            *headings(["case", "entrant", "paper’s model"], "text"),
            *headings(["folds", "ours", "published", "difference"]),
            *headings(["verdict"], "text"),
        ),
        rows=tuple(_row(pair, places, lettered[pair.published.erratum]) for pair in pairs),
        data=pd.DataFrame([_tidy(pair, metric) for pair in pairs]),
        notes=(*footnotes(lettered), *_rules(results.layout)),
    )


def _rules(layout: TaskLayout) -> tuple[str, ...]:
    return RULES if layout.independent_folds else WINDOW_RULES


def _row(pair: Comparison, places: int, mark: str) -> tuple[Cell, ...]:
    ours, published = pair.ours, pair.published
    note = "one fold" if pair.on_one_fold else pair.reason
    return (
        Cell(pair.case.name, note="synthetic" if pair.case.synthetic else ""),
        Cell(pair.label, kind="text"),
        Cell(published.model, kind="text"),
        Cell(f"n={ours.n}"),
        Cell(number(ours.mean, places), spread=_spread(ours.spread, places)),
        Cell(number(published.value, places), spread=_spread(published.two_sd, places), mark=mark),
        Cell(number(ours.mean - published.value, places)),
        Cell(pair.verdict.value, note=note, kind=slug(pair.verdict.value)),
    )


def _spread(two_sd: float | None, places: int) -> str:
    return "" if two_sd is None else number(two_sd, places)


def _tidy(pair: Comparison, metric: str) -> dict[str, object]:
    return {
        "task": pair.published.task,
        "case": pair.case.name,
        "label": pair.label,
        "metric": metric,
        **vars(pair.ours),
        "half_width": pair.half_width,
        "source": pair.published.source,
        "published_case": pair.published.case,
        "published_metric": pair.published.metric,
        "published_model": pair.published.model,
        "published": pair.published.value,
        "published_two_sd": pair.published.two_sd,
        "allowance": allowance(pair.published),
        "difference": pair.ours.mean - pair.published.value,
        "relative_difference": _relative(pair.ours.mean - pair.published.value, pair.published),
        "verdict": pair.verdict.value,
        "reason": pair.reason,
        "erratum": pair.published.erratum,
    }


def _relative(difference: float, published: PublishedValue) -> float:
    return difference / abs(published.value) if published.value else math.nan
