"""The table of best matches: a synthesiser is judged by the reference that it resembles most."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.tables.base import ABSENT, Cell, Table, decimals, headings, number, slug
from mocapbench.reports.tables.scores import SAMPLES, case_name

__all__ = ["match_table"]

BEST = "_best"
"""Ends the name of a metric that looks at the best-matched reference alone."""


def match_table(results: TaskResults) -> Table | None:
    """Return the mean over references beside the best-matched one; None where there is no choice.

    Only cases with several references have both.

    References
    ----------
    Thesis §A.4.2.
    """
    metrics = [name for best in _best_metrics(results) for name in (best.removesuffix(BEST), best)]
    rows = [
        (case, label)
        for case in results.cases
        for label in results.layout.labels
        if any(results.estimate(case.name, label, name) for name in metrics[1::2])
    ]
    if not rows:
        return None
    places = {name: _places(results, name) for name in metrics}
    return Table(
        id=slug(results.layout.name, "matches"),
        caption=f"Best-matched reference beside the mean over references: mean ± {SAMPLES}",
        columns=(
            *headings(["case", "entrant"], "text"),
            *headings([results.metrics[name].title for name in metrics]),
        ),
        rows=tuple(
            (
                Cell(case_name(case)),
                Cell(label, kind="text"),
                *(_cell(results, case.name, label, name, places[name]) for name in metrics),
            )
            for case, label in rows
        ),
        data=_tidy(results, [(case.name, label) for case, label in rows], metrics),
        notes=(
            "Real motions differ, so that no sample can resemble every reference: the thesis "
            "(§A.4.2) compares models by the one that is matched best. First rank in bold.",
        ),
    )


def _best_metrics(results: TaskResults) -> list[str]:
    scored = set(results.scores["metric"])
    return [name for name in results.metrics if name.endswith(BEST) and name in scored]


def _places(results: TaskResults, metric: str) -> int:
    return decimals(e.mean for (_, _, name), e in results.estimates.items() if name == metric)


def _cell(results: TaskResults, case: str, label: str, metric: str, places: int) -> Cell:
    estimate = results.estimate(case, label, metric)
    if estimate is None:
        return ABSENT
    spread = "" if estimate.spread is None else number(estimate.spread, places)
    kind = "best" if label in results.best(case, metric) else ""
    return Cell(number(estimate.mean, places), spread=spread, kind=kind)


def _tidy(
    results: TaskResults, rows: Sequence[tuple[str, str]], metrics: Sequence[str]
) -> pd.DataFrame:
    return pd.DataFrame(
        [
            {"case": case, "label": label, "metric": metric, **vars(estimate)}
            for case, label in rows
            for metric in metrics
            if (estimate := results.estimate(case, label, metric)) is not None
        ]
    )
