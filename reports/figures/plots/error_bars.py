"""Error bars by model: the mean with its interval, and every fold or person a dot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from seaborn import objects

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.cells import Cells, cells
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.export.means import columns_of
from mocapbench.reports.export.selection import order_labels
from mocapbench.reports.figures.plots.base import NothingToDrawError, Plot
from mocapbench.reports.figures.plots.choice import choose_metrics
from mocapbench.reports.figures.plots.look import (
    NARROW,
    Styles,
    fit_axis,
    scale_mark,
    scales_of,
    wrap_text,
)
from mocapbench.reports.figures.scale import LogScale, fit_scale

__all__ = ["ErrorBars"]

MOST_PANELS = 7
"""The mean over cases and six cases; of more cases the mean alone is drawn."""
_COLUMNS = (
    *("task", "metric", "quantity", "panel", "label"),
    *("unit", "value", "mean", "low", "high", "n", "n_of"),
)


class ErrorBars(Plot):
    """A panel for the mean over cases and each case, a row for each model, the best on top."""

    def tabulate(
        self, bundle: Bundle, results: TaskResults, metrics: Sequence[str]
    ) -> Mapping[str, pd.DataFrame]:
        """Return a row for each dot, with the mean of its model and the interval of that."""
        del bundle
        shown = choose_metrics(results, metrics)
        found = {metric: _tabulate_metric(results, metric) for metric in shown}
        tables = {metric: table for metric, table in found.items() if len(table)}
        if not tables:
            raise NothingToDrawError("no model has a score")
        return tables

    def draw(self, axes: Axes, panel: pd.DataFrame, styles: Styles) -> None:
        """Draw dots, means and intervals, which end where the axis does."""
        means = panel.drop_duplicates("label")
        looks = scales_of(panel["label"], styles)
        plot = (
            objects.Plot(panel, y="label", color="label", marker="label")
            .add(
                objects.Range(linewidth=scale_mark(1.5), alpha=0.5),
                data=means,
                orient="y",
                xmin="low",
                xmax="high",
                legend=False,
            )
            .add(objects.Dots(pointsize=scale_mark(3.0), stroke=0.6), x="value", legend=False)
            .add(objects.Dot(pointsize=scale_mark(5.0)), data=means, x="mean", legend=False)
            .scale(color=looks["color"], marker=looks["marker"])
        )
        plot.theme({}).on(axes).plot()
        fit_axis(axes, "x", [*panel["value"], *panel["mean"]])
        first = panel.iloc[0]
        quantity = wrap_text(first["quantity"], NARROW)
        axes.set(xlabel=quantity, ylabel="", title=wrap_text(first["panel"]))

    def height(self, panel: pd.DataFrame, width: float) -> float:
        """Return room for a row for each model."""
        del width
        return 6.0 + 1.5 * panel["label"].nunique()

    def describe(self, table: pd.DataFrame) -> str:
        """Return what dots and bars are, and over how many."""
        most = table.sort_values("n", kind="stable").iloc[-1]
        n, kind = int(most["n"]), str(most["n_of"])
        bars = (
            "bars their 95 % intervals by Student’s t, cut where the axis ends"
            if table["low"].notna().any()
            else f"without intervals, which one {kind} does not give"
        )
        of = format_count(n, kind) if n > 1 or kind == "fold" else f"folds of one {kind}"
        least = "" if table["n"].nunique() == 1 else " at most"
        scaled = any(_is_logarithmic(panel) for _, panel in table.groupby("panel"))
        axes = " Axes are logarithmic where values span a factor of ten." if scaled else ""
        return (
            f"Large markers are means, {bars}; small ones are single values, of {of}{least}.{axes}"
        )


def _is_logarithmic(panel: pd.DataFrame) -> bool:
    return isinstance(fit_scale([*panel["value"], *panel["mean"]], 0.0, 1.0), LogScale)


def _tabulate_metric(results: TaskResults, metric: str) -> pd.DataFrame:
    columns = [*columns_of(results, metric, alone=True)]
    scored = {case for case, _, name in results.estimates if name == metric}
    columns = [one for one in columns if scored.intersection(case.name for case in one[1])]
    shown = columns if len(columns) <= MOST_PANELS else columns[:1]
    ordered = order_labels(results, metric).layout.labels
    about = (results.layout.name, metric, results.metrics[metric].quantity)
    rows = [
        (*about, name, *dot)
        for name, cases in shown
        for dot in _list_dots(cells(results, metric, cases, ordered))
    ]
    return pd.DataFrame(rows, columns=list(_COLUMNS))


def _list_dots(scored: Cells) -> Iterator[tuple[object, ...]]:
    """Yield a row for each unit of each label, and its folds where these all are of one unit."""
    for row, label in enumerate(scored.labels):
        kept = scored.scored[row]
        mean, half, n = scored.mean(row), scored.half_width(row), scored.n_units(row)
        about = (mean, mean - half, mean + half, n, scored.unit)
        if n > 1:
            units = dict.fromkeys(np.array(scored.units)[kept].tolist())
            values = scored.by_unit(scored.values[[row]], kept)[0].tolist()
        else:
            units = dict.fromkeys(f"fold {number}" for number in np.flatnonzero(kept))
            values = scored.values[row, kept].tolist()
        yield from ((label, unit, value, *about) for unit, value in zip(units, values, strict=True))
