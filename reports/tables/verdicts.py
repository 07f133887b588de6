"""The table of our numbers beside the published ones, and the verdicts on them."""

from __future__ import annotations

from collections.abc import Mapping

from mocapbench.reports.analysis.comparisons import (
    Comparison,
    PublishedVerdict,
    answers,
    comparisons,
)
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.paper.remarks import PublishedAddress
from mocapbench.reports.tables.base import Cell, Table, headings
from mocapbench.reports.tables.letters import letters
from mocapbench.reports.text import decimals, number, plus_minus, slug

__all__ = ["verdict_table"]

KINDS = {
    verdict: "reproduced"
    if verdict in (PublishedVerdict.WITHIN_2_PERCENT, PublishedVerdict.WITHIN_PAPER_SD)
    else slug(verdict.value)
    for verdict in PublishedVerdict
}
"""The class of a verdict's cell in the style sheet."""


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
    lettered = letters(results)
    places = decimals(value for pair in pairs for value in (pair.ours.mean, pair.published.value))
    return Table(
        id=slug(results.layout.name, metric, "published"),
        caption=f"{results.metrics[metric].short}: ours beside the published value",
        columns=(
            *headings(["case", "entrant", "paper’s model"], "text"),
            *headings(["folds", "ours", "published", "difference"]),
            *headings(["verdict"], "text"),
        ),
        rows=tuple(_row(pair, places, lettered, counts=_counts(pair, answering)) for pair in pairs),
    )


def _counts(pair: Comparison, answering: Mapping[PublishedAddress, Comparison]) -> bool:
    """Return whether the pair, or none that may be compared, answers the published value."""
    answer = answering.get(pair.published.address)
    return answer is None or (answer.case, answer.label) == (pair.case, pair.label)


def _row(
    pair: Comparison, places: int, lettered: Mapping[str, str], *, counts: bool
) -> tuple[Cell, ...]:
    ours, published = pair.ours, pair.published
    note = "one fold" if pair.on_one_fold else ""
    beside = "" if counts else "beside"
    return (
        Cell(pair.case.name, note="synthetic" if pair.case.synthetic else ""),
        Cell(pair.label, kind="text"),
        Cell(published.model, kind="text"),
        Cell(f"n={ours.n}"),
        Cell(number(ours.mean, places), spread=plus_minus(ours.two_sd, places)),
        Cell(
            number(published.value, places),
            spread=plus_minus(published.two_sd, places),
            mark=lettered[published.erratum],
        ),
        Cell(number(ours.mean - published.value, places)),
        Cell(
            pair.verdict.value,
            note=", ".join(filter(None, (beside, note))),
            mark=lettered[pair.reason],
            kind=KINDS[pair.verdict],
        ),
    )
