"""Error against a column of the cases: the length of gaps, or the number of training recordings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from seaborn import objects

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.estimates import FoldMean
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.plots.base import NothingToDrawError, Plot
from mocapbench.reports.figures.plots.choice import choose_labels, choose_metrics, count_models
from mocapbench.reports.figures.plots.look import (
    Styles,
    fit_axis,
    fit_count_axis,
    scale_mark,
    scales_of,
    wrap_text,
)
from mocapbench.reports.figures.scores.along import N_BANDS, group_cases

__all__ = ["AlongColumn"]

_COLUMNS = (
    *("task", "metric", "quantity", "panel", "column", "x"),
    *("label", "mean", "low", "high", "n"),
)


class AlongColumn(Plot):
    """A curve for each model, a panel for the cases that are alike in all other columns.

    Parameters
    ----------
    column : str
        A column of cases that holds numbers.
    title : str
        What it is.
    """

    def __init__(self, column: str, title: str) -> None:
        self.column: str = column
        self.title: str = title

    def tabulate(
        self, bundle: Bundle, results: TaskResults, metrics: Sequence[str]
    ) -> Mapping[str, pd.DataFrame]:
        """Return a row for each point of a curve."""
        del bundle
        if self.column not in results.layout.page.along:
            raise NothingToDrawError(f"its cases do not differ in {self.title}")
        shown = choose_metrics(results, metrics)
        found = {metric: self._tabulate_metric(results, metric) for metric in shown}
        tables = {metric: table for metric, table in found.items() if len(table)}
        if not tables:
            raise NothingToDrawError(f"the cases that ran do not differ in {self.title} alone")
        return tables

    def draw(self, axes: Axes, panel: pd.DataFrame, styles: Styles) -> None:
        """Draw the curves, and intervals as shaded areas."""
        plot = (
            objects.Plot(panel, x="x", y="mean", color="label", marker="label")
            .add(
                objects.Band(alpha=0.12, edgewidth=0.0),
                data=panel[panel["label"].isin(self.keys(panel)[:N_BANDS])],
                ymin="low",
                ymax="high",
                legend=False,
            )
            .add(
                objects.Line(linewidth=scale_mark(1.2), pointsize=scale_mark(3.5)),
                linestyle="label",
                legend=False,
            )
            .scale(**scales_of(panel["label"], styles))
        )
        plot.theme({}).on(axes).plot()
        fit_axis(axes, "y", panel["mean"])
        self._fit_column(axes, panel["x"])
        axes.set(
            xlabel=self.title,
            ylabel=panel["quantity"].iloc[0],
            title=wrap_text(panel["panel"].iloc[0]),
        )

    def _fit_column(self, axes: Axes, places: Iterable[float]) -> None:
        """Let the horizontal axis show the column, with a tick at each place."""
        shown = sorted({*places})
        if 0.0 in shown:
            fit_count_axis(axes, shown)
        else:
            fit_axis(axes, "x", shown)
            axes.set_xticks(shown, [f"{place:g}" for place in shown])

    def height(self, panel: pd.DataFrame, width: float) -> float:
        """Return a height in proportion to the width."""
        del panel
        return 0.7 * width

    def describe(self, table: pd.DataFrame) -> str:
        """Return what is drawn of which models."""
        shaded = table["low"].notna().any()
        first = f", shaded areas 95 % intervals of the first {N_BANDS} models"
        areas = f"{first}, cut where the axis ends" if shaded else ""
        folds = format_count(int(table["n"].max()), "fold")
        return f"Points are means over {folds}{areas}."

    def keys(self, table: pd.DataFrame) -> Sequence[str]:
        """Return the models."""
        return [*dict.fromkeys(table["label"])]

    def _tabulate_metric(self, results: TaskResults, metric: str) -> pd.DataFrame:
        groups = group_cases(results, metric, self.column)
        scored = {label for _, label, name in results.estimates if name == metric}
        about = (results.layout.name, metric, results.metrics[metric].quantity)
        rows = [
            (*about, heading, self.column, _number(case, self.column), label, *_mean(estimate))
            for heading, cases in groups.items()
            for label in choose_labels(results, metric, scored)
            for case in sorted(cases, key=lambda one: _number(one, self.column))
            if (estimate := results.estimate(case.name, label, metric)) is not None
        ]
        return count_models(pd.DataFrame(rows, columns=list(_COLUMNS)), len(scored))


def _number(case: CaseLayout, column: str) -> float:
    return float(case.columns[column])


def _mean(estimate: FoldMean) -> tuple[float, float, float, int]:
    half = np.nan if estimate.half_width is None else estimate.half_width
    return estimate.mean, estimate.mean - half, estimate.mean + half, estimate.n
