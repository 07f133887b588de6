"""The table of our numbers beside the published ones, with the rule of the verdicts below it."""

from __future__ import annotations

import math

import pandas as pd

from mocapbench.reports.analysis.comparisons import Comparison, comparisons
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.verdicts import allowance
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.paper.remarks import footnotes, marks
from mocapbench.reports.tables.base import Cell, Table, headings
from mocapbench.reports.text import decimals, number, plus_minus, slug

__all__ = ["verdict_table"]

ALLOWANCE = "2 % of the published value, or the ± that the paper prints where that is more"
RULES = (
    f"Reproduced: our mean differs from the published value by no more than the allowance "
    f"({ALLOWANCE}), and half its 95 % interval over folds (Student’s t) is no wider than the "
    "allowance.",
    "Better, worse: the published value lies outside our interval widened by the allowance. "
    "Undecided: neither, because the folds are too few or too noisy.",
    "One fold has no interval: its verdict rests on the difference alone.",
)
WINDOW_RULES = (
    f"Reproduced: our mean differs from the published value by no more than the allowance "
    f"({ALLOWANCE}). Better, worse: it differs by more.",
    "The folds are overlapping windows of one recording, and the published value is a mean over "
    "all windows of the paper. The ± is the spread over windows, and the verdict compares means "
    "only. A run with fewer windows than the paper averages over another set.",
)


def verdict_table(results: TaskResults, metric: str) -> Table | None:
    """Return the table of our mean, the published value, their difference and the verdict.

    Returns
    -------
    Table or None
        None where no value of ours has a published counterpart.
    """
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
        Cell(number(ours.mean, places), spread=plus_minus(ours.spread, places)),
        Cell(
            number(published.value, places), spread=plus_minus(published.two_sd, places), mark=mark
        ),
        Cell(number(ours.mean - published.value, places)),
        Cell(pair.verdict.value, note=note, kind=slug(pair.verdict.value)),
    )


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
