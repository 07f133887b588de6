"""The paper's table of one metric: a row per case, a column per entrant, mean ± interval."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from mocapbench.reports.analysis.fold_mean import FoldMean
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.paper.remarks import footnotes
from mocapbench.reports.tables.base import Cell, Table, headings
from mocapbench.reports.tables.published_columns import (
    lettered_errata,
    published_cells,
    unmatched_models,
)
from mocapbench.reports.tables.score_cells import folds_cell, score_cells
from mocapbench.reports.tables.score_notes import score_caption, score_notes
from mocapbench.reports.text import decimals, slug

__all__ = ["case_columns", "metric_decimals", "score_table"]


def case_columns(cases: Sequence[CaseLayout]) -> list[str]:
    """Return the names of the columns of all cases, in order of first appearance."""
    return list(dict.fromkeys(name for case in cases for name in case.columns))


def metric_decimals(results: TaskResults, metric: str) -> int:
    """Return how many decimals the means of ``metric`` are shown with."""
    return decimals(e.mean for (_, _, name), e in results.estimates.items() if name == metric)


def score_table(results: TaskResults, metric: str) -> Table:
    """Return the table of ``metric``; the paper's models that have no entrant here come last."""
    columns, models = case_columns(results.cases), unmatched_models(results, metric)
    errata = lettered_errata(results, metric)
    return Table(
        id=slug(results.layout.name, metric),
        caption=score_caption(results, metric),
        columns=(
            *headings(["case", *columns, "folds", *results.layout.labels]),
            *headings([f"{model} (published)" for model in models], "published"),
        ),
        rows=tuple(_row(results, case, metric, errata) for case in results.cases),
        data=_tidy(results, metric),
        notes=(*score_notes(results, metric), *footnotes(errata)),
    )


def _row(
    results: TaskResults, case: CaseLayout, metric: str, errata: Mapping[str, str]
) -> tuple[Cell, ...]:
    places = metric_decimals(results, metric)
    return (
        Cell(case.name, note=_case_note(case)),
        *(Cell(str(case.columns.get(name, ""))) for name in case_columns(results.cases)),
        folds_cell(results, case.name, metric),
        *score_cells(results, case.name, metric, places),
        *published_cells(results, case, metric, places, errata),
    )


def _case_note(case: CaseLayout) -> str:
    return " · ".join(filter(None, ["synthetic" if case.synthetic else "", case.remark]))


def _tidy(results: TaskResults, metric: str) -> pd.DataFrame:
    """Return one row per (case, label), with n = 0 where there is no score."""
    best = {case.name: results.best_label(case.name, metric) for case in results.cases}
    return pd.DataFrame(
        [
            {
                "task": results.layout.name,
                "case": case.name,
                **case.columns,
                "synthetic": case.synthetic,
                "label": label,
                "metric": metric,
                **vars(results.estimate(case.name, label, metric) or FoldMean(np.nan, None, 0)),
                "best": label == best[case.name],
            }
            for case in results.cases
            for label in results.layout.labels
        ]
    )
