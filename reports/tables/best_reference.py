"""The table of best-matched references: the score by the reference most similar to the samples.

The thesis compares synthesisers by this score (J. D. Gil López, *Hierarchical Multiple Output
Gaussian Processes for Human Motion Data*, MSc thesis, Universidad Tecnológica de Pereira, 2017,
§A.4.2).
"""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings
from mocapbench.reports.text import number, plus_minus, slug

__all__ = ["best_reference_table"]

BEST = "_best"
"""Suffix of a metric that looks at the best-matched reference alone."""


def best_reference_table(results: TaskResults) -> Table | None:
    """Return the mean over references beside the score by the best-matched reference.

    Returns
    -------
    Table or None
        Rows are the cases with several references; None where there is no such case.
    """
    best = _best_metrics(results)
    metrics = [name for pair in ((name.removesuffix(BEST), name) for name in best) for name in pair]
    rows = [
        (case, label)
        for case in results.cases
        for label in results.layout.labels
        if any(results.estimate(case.name, label, name) for name in best)
    ]
    if not rows:
        return None
    return Table(
        id=slug(results.layout.name, "matches"),
        caption="Best-matched reference beside all references, ± over samples",
        columns=(
            *headings(["case", "entrant"], "text"),
            *headings([results.metrics[name].title for name in metrics]),
        ),
        rows=tuple(_row(results, case, label, metrics) for case, label in rows),
    )


def _best_metrics(results: TaskResults) -> list[str]:
    scored = set(results.scores["metric"])
    return [name for name in results.metrics if name.endswith(BEST) and name in scored]


def _row(
    results: TaskResults, case: CaseLayout, label: str, metrics: Sequence[str]
) -> tuple[Cell, ...]:
    cells = (_cell(results, case.name, label, metric) for metric in metrics)
    return (Cell(case.heading), Cell(label, kind="text"), *cells)


def _cell(results: TaskResults, case: str, label: str, metric: str) -> Cell:
    estimate = results.estimate(case, label, metric)
    if estimate is None:
        return ABSENT
    places = results.decimals[metric]
    spread = plus_minus(estimate.sample_two_sd, places)
    kind = "best" if label == results.best_label(case, metric) else ""
    return Cell(number(estimate.mean, places), spread=spread, kind=kind)
