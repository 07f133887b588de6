"""Rank diagrams: mean ranks of models, and bars that join those that are not separable."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pandas as pd
from matplotlib.axes import Axes
from seaborn import objects

from mocapbench.basics.words import format_count
from mocapbench.metrics.statistics import friedman, nemenyi
from mocapbench.reports.analysis.ranks import ranks_over_units
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.figures.plots.base import NothingToDrawError, Plot
from mocapbench.reports.figures.plots.choice import choose_metrics
from mocapbench.reports.figures.plots.look import NARROW, Styles, scale_mark, scales_of, wrap_text
from mocapbench.reports.figures.scores.ranks import rank_labels

__all__ = ["Ranks"]

_COLUMNS = (
    *("task", "metric", "quantity", "panel", "label", "mean_rank", "groups"),
    *("friedman_p", "critical_difference", "n", "n_of"),
)


class Ranks(Plot):
    """A row for each model, the best on top; a bar for each group that is not separable."""

    def tabulate(
        self, bundle: Bundle, results: TaskResults, metrics: Sequence[str]
    ) -> Mapping[str, pd.DataFrame]:
        """Return a row for each model, with the numbers of the groups that it is in."""
        del bundle
        shown = choose_metrics(results, metrics)
        losses = {metric: ranks_over_units(results, metric) for metric in shown}
        tables = {
            metric: _tabulate_ranks(results, metric, found.dropna(axis=1))
            for metric, found in losses.items()
            if found is not None
        }
        if not tables:
            raise NothingToDrawError("it has too few cases or people for ranks to separate models")
        return tables

    def draw(self, axes: Axes, panel: pd.DataFrame, styles: Styles) -> None:
        """Draw the mean ranks, and the bars beyond the last rank."""
        looks = scales_of(panel["label"], styles)
        plot = (
            objects.Plot(panel, x="mean_rank", y="label", color="label", marker="label")
            .add(objects.Dot(pointsize=scale_mark(5)), legend=False)
            .scale(color=looks["color"], marker=looks["marker"])
        )
        plot.theme({}).on(axes).plot()
        _draw_bars(axes, panel)
        about = f"mean rank by {panel['quantity'].iloc[0]} (1 is best)"
        axes.set(ylabel="", xlabel=wrap_text(about, NARROW))

    def height(self, panel: pd.DataFrame, width: float) -> float:
        """Return room for a row for each model."""
        del width
        return 5.0 + 1.5 * len(panel)

    def describe(self, table: pd.DataFrame) -> str:
        """Return the test, and what bars mean."""
        first = table.iloc[0]
        return (
            f"Mean ranks over {format_count(int(first['n']), str(first['n_of']))}. Friedman’s test "
            f"of no difference: p = {first['friedman_p']:.2g}; Nemenyi’s critical difference at "
            f"5 %: {first['critical_difference']:.2f} ranks. Bars join models that are not "
            "separable."
        )


def _tabulate_ranks(results: TaskResults, metric: str, losses: pd.DataFrame) -> pd.DataFrame:
    means, groups = rank_labels(losses)
    about = (results.layout.name, metric, results.metrics[metric].quantity, "")
    test = (friedman(losses), nemenyi(*losses.shape), len(losses), str(losses.index.name))
    rows = [
        (*about, label, mean, " ".join(_list_numbers(groups, str(label))), *test)
        for label, mean in means.items()
    ]
    return pd.DataFrame(rows, columns=list(_COLUMNS))


def _list_numbers(groups: Sequence[Sequence[str]], label: str) -> list[str]:
    return [str(number) for number, group in enumerate(groups, 1) if label in group]


def _draw_bars(axes: Axes, panel: pd.DataFrame) -> None:
    """Draw a vertical bar for each group, beside each other."""
    members = panel["groups"].str.split()
    last, step = float(panel["mean_rank"].max()), 0.03 * len(panel)
    numbers = sorted({number for names in members for number in names}, key=int)
    for place, number in enumerate(numbers):
        rows = [row for row, names in enumerate(members) if number in names]
        x = last + (2 + place) * step
        axes.plot([x, x], [rows[0] - 0.2, rows[-1] + 0.2], color="#1c2126", linewidth=2.0)
