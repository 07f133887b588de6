"""Which tasks, cases and models of a run a table shows, and in which order."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import pandas as pd

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import standings
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.layout import TaskLayout

__all__ = ["order_labels", "select_results"]


def select_results(
    bundle: Bundle, tasks: Sequence[str], cases: Sequence[str] = (), labels: Sequence[str] = ()
) -> Bundle:
    """Return what a bundle has of some tasks, cases and labels, in the order in which these are.

    Parameters
    ----------
    bundle : Bundle
    tasks : sequence of str
    cases, labels : sequence of str, optional
        By default all, in table order. A task that has none of them is left out.
    """
    layouts = {layout.name: _narrow(layout, cases, labels) for layout in bundle.layouts}
    kept = [layouts[name] for name in tasks if layouts[name].cases and layouts[name].labels]
    return replace(
        bundle,
        scores=_rows_of(bundle.scores, kept),
        records=_rows_of(bundle.records, kept),
        layouts=tuple(kept),
        illustrations=(),
    )


def order_labels(results: TaskResults, metric: str) -> TaskResults:
    """Return results whose labels are as the page orders them: best first, references last."""
    layout = results.layout
    ranked = [standing.label for standing in standings(results, metric)]
    labels = dict.fromkeys([*ranked, *layout.ranked, *layout.labels])
    return replace(results, layout=replace(layout, labels=tuple(labels)))


def _narrow(layout: TaskLayout, cases: Sequence[str], labels: Sequence[str]) -> TaskLayout:
    by_name = {case.name: case for case in layout.cases}
    return replace(
        layout,
        cases=tuple(by_name[name] for name in cases or by_name if name in by_name),
        labels=tuple(label for label in labels or layout.labels if label in layout.labels),
    )


def _rows_of(table: pd.DataFrame, layouts: Sequence[TaskLayout]) -> pd.DataFrame:
    """Return the rows of the cells that the layouts have."""
    wanted = pd.MultiIndex.from_tuples(
        [
            (layout.name, case.name, label)
            for layout in layouts
            for case in layout.cases
            for label in layout.labels
        ],
        names=["task", "case", "label"],
    )
    return table[pd.MultiIndex.from_frame(table[wanted.names]).isin(wanted)]
