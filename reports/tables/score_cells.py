"""The cells of one row of a score table: folds, scores, and jobs without a score."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from mocapbench.reports.analysis.fold_mean import FoldMean
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.troubles import DATA_MISSING, Trouble
from mocapbench.reports.tables.base import ABSENT, Cell
from mocapbench.reports.text import cell_anchor, number, plus_minus

__all__ = ["MISSING_ID", "folds_cell", "score_cells"]

MISSING_ID = "missing-data"
"""Anchor of the page's list of missing data."""


def folds_cell(results: TaskResults, case: str, metric: str) -> Cell:
    """Return the number of folds of a row, and whether its first rank was tested."""
    rank = results.first_rank(case, metric)
    untested = rank is not None and not rank.tested
    return Cell(f"n={_n_folds(results, case, metric)}", note="no test" if untested else "")


def score_cells(results: TaskResults, case: str, metric: str, places: int) -> list[Cell]:
    """Return a cell for each label, or one cell across all of them where the data are missing."""
    labels = results.layout.labels
    records = results.records[results.records["case"] == case]
    if (records["status"] == DATA_MISSING).all():
        return [Cell("data missing", kind="trouble", link=MISSING_ID, span=len(labels))]
    best, expected = results.best(case, metric), _n_folds(results, case, metric)
    return [
        _score(
            results.estimate(case, label, metric),
            results.troubles.get((case, label), ()),
            "best" if label in best else "",
            expected,
            places,
            opens=cell_anchor(results.layout.name, case, label),
        )
        for label in labels
    ]


def _n_folds(results: TaskResults, case: str, metric: str) -> int:
    estimates = (results.estimate(case, label, metric) for label in results.layout.labels)
    return max((estimate.n for estimate in estimates if estimate), default=0)


def _score(
    estimate: FoldMean | None,
    troubles: Sequence[Trouble],
    kind: str,
    expected: int,
    places: int,
    *,
    opens: str,
) -> Cell:
    counts = Counter(trouble.status.replace("-", " ") for trouble in troubles)
    link = _anchor(troubles[0]) if troubles else ""
    if estimate is None:
        return Cell(", ".join(counts), kind="trouble", link=link) if troubles else ABSENT
    remaining = "" if expected == estimate.n else f"n={estimate.n}"
    lost = [f"{count} {status}" for status, count in counts.items()]
    return Cell(
        text=number(estimate.mean, places),
        spread=plus_minus(estimate.spread, places),
        note=", ".join(filter(None, [remaining, *lost])),
        kind=kind,
        link=link,
        opens=opens,
    )


def _anchor(trouble: Trouble) -> str:
    return MISSING_ID if trouble.status == DATA_MISSING else trouble.id
