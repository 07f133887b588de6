"""The error-bar figure: a point per case and entrant, with a 95 % interval where folds give one.

Markers and line styles distinguish the entrants without colour. Generated motion has separate axes:
its scale differs, and no line joins it to recordings of people.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import pandas as pd
import seaborn as sns
from markupsafe import Markup
from matplotlib import rc_context
from matplotlib.figure import Figure

from mocapbench.reports.analysis.fold_mean import FoldMean
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.styles import (
    LINES,
    MARKERS,
    SMALLEST_SCALE,
    cycled,
    line_swatch,
)
from mocapbench.reports.figures.svg import PALETTE, STYLE, svg_element
from mocapbench.reports.figures.svg_figure import Key, SvgFigure
from mocapbench.reports.text import counted, slug

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["error_bars", "t_interval"]

MARKER_SIZE, LINE_WIDTH = 4.5, 1.0
LOG_RANGE = 20.0
SMALLEST_WIDTH = 4.9
INTERVALS = "mean and 95 % interval over folds (Student’s t). A single fold has no interval."
POINTS = (
    "mean over folds. The folds are overlapping windows of one recording and not independent, "
    "so there is no interval."
)


def t_interval(values: pd.Series[float]) -> tuple[float, float]:
    """Return the 95 % interval of the mean by Student's t; the point itself for one value."""
    estimate = FoldMean.of(values.to_list())
    half = estimate.half_width or 0.0
    return estimate.mean - half, estimate.mean + half


def error_bars(results: TaskResults, metric: str) -> SvgFigure | None:
    """Return the figure of ``metric``; None where there is no score."""
    data = results.scores[results.scores["metric"] == metric]
    scored, prefix = set(data["label"]), slug(results.layout.name, metric, "figure")
    places = {label: i for i, label in enumerate(results.layout.labels) if label in scored}
    if not places:
        return None
    with rc_context(STYLE):
        return SvgFigure(
            results.metrics[metric].title,
            _svg(results, metric, data, places, prefix),
            tuple(Key(label, _swatch(i, f"{prefix}-key-{i}")) for label, i in places.items()),
            INTERVALS if results.layout.independent_folds else POINTS,
        )


def _svg(
    results: TaskResults, metric: str, data: pd.DataFrame, places: dict[str, int], prefix: str
) -> Markup:
    title, with_data = results.metrics[metric].title, set(data["case"])
    cases = [case for case in results.cases if case.name in with_data]
    headings = {case.name: case.heading for case in cases}
    orders = _groups(cases)
    widths = _widths(orders)
    figure = Figure(figsize=(sum(widths), 3.4), layout="constrained")
    row = figure.subplots(1, len(orders), squeeze=False, width_ratios=widths)[0]
    errorbar = t_interval if results.layout.independent_folds else None
    named = data.assign(case=data["case"].map(headings))
    for axes, order, width in zip(row, orders, widths, strict=True):
        shown = named[named["case"].isin(order)]
        _draw(axes, shown, order, places, errorbar)
        _finish(axes, title, shown["value"], tilted=_collide(order, width))
    return svg_element(
        figure,
        prefix,
        role="img",
        aria_label=f"{title} of {counted(len(places), 'entrant')} in {counted(len(cases), 'case')}",
        style=f"min-width: {SMALLEST_SCALE * sum(widths):.2f}in",
    )


def _groups(cases: Sequence[CaseLayout]) -> list[list[str]]:
    """Return the headings of the cases with recordings and of those with generated motion."""
    groups = [
        [case.heading for case in cases if case.synthetic is generated]
        for generated in (False, True)
    ]
    return [group for group in groups if group]


def _widths(orders: Sequence[Sequence[str]]) -> list[float]:
    """Return the width in inches of the axes of each order of cases."""
    widths = [1.0 + 0.85 * len(order) for order in orders]
    return [width * max(1.0, SMALLEST_WIDTH / sum(widths)) for width in widths]


def _draw(
    axes: Axes,
    data: pd.DataFrame,
    order: list[str],
    places: dict[str, int],
    errorbar: Callable[[pd.Series[float]], tuple[float, float]] | None,
) -> None:
    """Draw one series per label, in the style of its place among the task's labels."""
    sns.pointplot(
        data=data,
        x="case",
        y="value",
        hue="label",
        order=order,
        hue_order=list(places),
        palette=[cycled(PALETTE, place) for place in places.values()],
        markers=[cycled(MARKERS, place) for place in places.values()],
        linestyles=[cycled(LINES, place) for place in places.values()],
        dodge=0.6 if len(places) > 1 else False,
        errorbar=errorbar,
        legend=False,
        markersize=MARKER_SIZE,
        linewidth=LINE_WIDTH,
        err_kws={"linewidth": 1.4},
        ax=axes,
    )


def _finish(axes: Axes, title: str, values: pd.Series[float], *, tilted: bool) -> None:
    axes.set(xlabel="", ylabel=title, yscale=_scale(values))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.grid(axis="y", linewidth=0.6)
    axes.tick_params(axis="x", length=0)
    if tilted:
        for label in axes.get_xticklabels():
            label.set(rotation=30, ha="right", rotation_mode="anchor")


def _collide(names: Sequence[str], width: float) -> bool:
    """Return whether names, at six points a letter, touch side by side in ``width`` inches."""
    return 6.0 * max(map(len, names)) > 72.0 * (width - 0.8) / len(names)


def _scale(values: pd.Series[float]) -> str:
    """Return the scale of the axis: logarithmic where the values span orders of magnitude."""
    positive = values.min() > 0.0
    return "log" if positive and values.max() > LOG_RANGE * values.min() else "linear"


def _swatch(place: int, prefix: str) -> Markup:
    """Return the line and marker of the label at ``place``."""
    return line_swatch(
        prefix,
        [0.0, 0.5, 1.0],
        color=cycled(PALETTE, place),
        marker=cycled(MARKERS, place),
        linestyle=cycled(LINES, place),
        markersize=MARKER_SIZE,
        linewidth=LINE_WIDTH,
        markeredgewidth=0.75 * LINE_WIDTH,  # as seaborn does
        markevery=[1],
    )
