"""The table of our numbers beside the published ones, with the rule of the verdicts below it."""

from __future__ import annotations

import math
from collections.abc import Mapping

import pandas as pd

from mocapbench.reports.analysis.published.comparisons import Comparison, answers, comparisons
from mocapbench.reports.analysis.published.verdicts import PublishedVerdict, allowance
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.paper.remarks import PublishedAddress, footnotes, marks
from mocapbench.reports.tables.base import Cell, Table, headings
from mocapbench.reports.text import decimals, number, plus_minus, slug

__all__ = ["verdict_table"]

KINDS = {
    verdict: "reproduced"
    if verdict in (PublishedVerdict.WITHIN_2_PERCENT, PublishedVerdict.WITHIN_PAPER_SD)
    else slug(verdict.value)
    for verdict in PublishedVerdict
}
"""The class of a verdict's cell in the style sheet."""
RULES = (
    "The ± is two standard deviations over folds, as the papers print it, and not the interval of "
    "the other tables.",
    "Within 2 %: our mean differs from the published value by no more than 2 % of it, and half its "
    "95 % interval (Student’s t) is no wider. Within the paper’s ±: the same of the ± that the "
    "paper prints, where it prints one.",
    "Better, worse: the published value lies outside our interval widened by the greater of the "
    "two. Undecided: none of these, because the folds are too few or too noisy.",
    "One unit, such as one fold or windows of one recording, has no interval: the verdict rests on "
    "the difference alone. A run with fewer windows than the paper averages over another set.",
    "Beside: another row or entrant answers the value, and only that one counts in the totals. It "
    "is the first in the order of the tables that may be compared and has a score.",
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
    answering = answers(results)
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
        rows=tuple(
            _row(pair, places, lettered[pair.published.erratum], counts=_counts(pair, answering))
            for pair in pairs
        ),
        data=pd.DataFrame([_tidy(pair, counts=_counts(pair, answering)) for pair in pairs]),
        notes=(*footnotes(lettered), *RULES),
    )


def _counts(pair: Comparison, answering: Mapping[PublishedAddress, Comparison]) -> bool:
    """Return whether the pair, or none that may be compared, answers the published value."""
    answer = answering.get(pair.published.address)
    return answer is None or (answer.case, answer.label) == (pair.case, pair.label)


def _row(pair: Comparison, places: int, mark: str, *, counts: bool) -> tuple[Cell, ...]:
    ours, published = pair.ours, pair.published
    note = "one fold" if pair.on_one_fold else pair.reason
    beside = "" if counts else "beside"
    return (
        Cell(pair.case.name, note="synthetic" if pair.case.synthetic else ""),
        Cell(pair.label, kind="text"),
        Cell(published.model, kind="text"),
        Cell(f"n={ours.n}"),
        Cell(number(ours.mean, places), spread=plus_minus(ours.two_sd, places)),
        Cell(
            number(published.value, places), spread=plus_minus(published.two_sd, places), mark=mark
        ),
        Cell(number(ours.mean - published.value, places)),
        Cell(
            pair.verdict.value,
            note=", ".join(filter(None, (beside, note))),
            kind=KINDS[pair.verdict],
        ),
    )


def _tidy(pair: Comparison, *, counts: bool) -> dict[str, object]:
    return {
        "task": pair.published.task,
        "case": pair.case.name,
        "label": pair.label,
        "metric": pair.metric,
        **vars(pair.ours),
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
        "counts": counts,
        "reason": pair.reason,
        "erratum": pair.published.erratum,
    }


def _relative(difference: float, published: PublishedValue) -> float:
    return difference / abs(published.value) if published.value else math.nan
