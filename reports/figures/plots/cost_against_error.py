"""Cost against error, with the line of the models that nothing cheaper beats."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pandas as pd
from matplotlib.axes import Axes
from seaborn import objects

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.figures.plots.base import NothingToDrawError, Plot
from mocapbench.reports.figures.plots.choice import choose_labels, choose_metrics, count_models
from mocapbench.reports.figures.plots.look import Styles, fit_axis, scale_mark, scales_of
from mocapbench.reports.figures.scores.best import mean_values
from mocapbench.reports.figures.scores.cost import front, median_seconds

__all__ = ["Cost"]

FEWEST = 2
_COLUMNS = ("task", "metric", "quantity", "panel", "label", "mean", "seconds", "on_front")


class Cost(Plot):
    """A point for each model that has a score in every case and whose jobs were timed."""

    def tabulate(
        self, bundle: Bundle, results: TaskResults, metrics: Sequence[str]
    ) -> Mapping[str, pd.DataFrame]:
        """Return a row for each model."""
        del bundle
        shown = choose_metrics(results, metrics)
        found = {metric: _tabulate_metric(results, metric) for metric in shown}
        tables = {metric: table for metric, table in found.items() if len(table) >= FEWEST}
        if not tables:
            raise NothingToDrawError("fewer than two models have a score in every case")
        return tables

    def draw(self, axes: Axes, panel: pd.DataFrame, styles: Styles) -> None:
        """Draw the line and the points."""
        looks = scales_of(panel["label"], styles)
        best = panel[panel["on_front"]].sort_values("mean", kind="stable")
        axes.plot(best["mean"], best["seconds"], color="#57606a", linewidth=0.8, zorder=0)
        plot = (
            objects.Plot(panel, x="mean", y="seconds", color="label", marker="label")
            .add(objects.Dot(pointsize=scale_mark(5)), legend=False)
            .scale(color=looks["color"], marker=looks["marker"])
        )
        plot.theme({}).on(axes).plot()
        fit_axis(axes, "x", panel["mean"])
        fit_axis(axes, "y", panel["seconds"])
        axes.set(xlabel=panel["quantity"].iloc[0], ylabel="median seconds a fold")

    def height(self, panel: pd.DataFrame, width: float) -> float:
        """Return a height in proportion to the width."""
        del panel
        return 0.75 * width

    def describe(self, table: pd.DataFrame) -> str:
        """Return what points and the line are."""
        best = ", ".join(table["label"][table["on_front"]])
        return (
            "Median seconds to fit and predict against the mean over cases. No other model is both "
            f"better and cheaper than those on the line: {best}."
        )

    def keys(self, table: pd.DataFrame) -> Sequence[str]:
        """Return the models."""
        return [*table["label"]]


def _tabulate_metric(results: TaskResults, metric: str) -> pd.DataFrame:
    means, seconds = mean_values(results, metric), median_seconds(results)
    labels = [label for label in means if label in seconds]
    loss, ranked = results.metrics[metric].loss, results.layout.ranked
    competing = [label for label in labels if label in ranked]
    best = front([(loss(means[label]), seconds[label]) for label in competing])
    on_front = [competing[place] for place in best]
    about = (results.layout.name, metric, results.metrics[metric].quantity, "")
    shown = [*dict.fromkeys([*choose_labels(results, metric, labels), *on_front])]
    rows = [(*about, name, means[name], seconds[name], name in on_front) for name in shown]
    return count_models(pd.DataFrame(rows, columns=list(_COLUMNS)), len(labels))
