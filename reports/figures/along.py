"""Scores as curves along a column of numbers, such as the length of a gap."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.bundle.panels import Curve, Illustration, Panel
from mocapbench.reports.figures import panels
from mocapbench.reports.figures.svg_figure import SvgFigure

__all__ = ["curves_along"]


def curves_along(results: TaskResults, metric: str, column: str) -> SvgFigure | None:
    """Return the means over folds of each entrant as a curve along a column of the cases.

    Parameters
    ----------
    results : TaskResults
    metric : str
    column : str
        A column of the cases that holds numbers. Cases that are alike in all other columns share
        a panel.

    Returns
    -------
    SvgFigure or None
        None where no panel has two numbers with scores.
    """
    alike = defaultdict(list)
    for case in results.cases:
        if results.ranking(case.name, metric):
            alike[_heading(case, column)].append(case)
    drawn = [_panel(results, metric, column, cases) for cases in alike.values() if len(cases) > 1]
    if not drawn:
        return None
    title = results.metrics[metric].title
    caption = f"mean over folds along {column}; the table has its uncertainty."
    return panels.draw(Illustration(results.layout.name, title, caption, tuple(drawn)))


def _panel(results: TaskResults, metric: str, column: str, cases: Sequence[CaseLayout]) -> Panel:
    places = np.array([float(case.columns[column]) for case in cases])
    curves = (
        Curve(places, np.array([_mean(results, metric, case, label) for case in cases]), label)
        for label in results.layout.labels
    )
    shown = tuple(curve for curve in curves if np.isfinite(curve.y).any())
    return Panel(_heading(cases[0], column), column, "mean over folds", shown)


def _mean(results: TaskResults, metric: str, case: CaseLayout, label: str) -> float:
    estimate = results.estimate(case.name, label, metric)
    return estimate.mean if estimate else float("nan")


def _heading(case: CaseLayout, column: str) -> str:
    """Return what the case says in all columns but one."""
    others = [str(value) for name, value in case.columns.items() if name != column]
    return ", ".join([*others, "synthetic"] if case.synthetic else others)
