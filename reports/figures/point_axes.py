"""One set of axes of the error-bar figure: points, intervals, and the look of the axes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import pandas as pd
import seaborn as sns

from mocapbench.reports.analysis.fold_mean import FoldMean
from mocapbench.reports.figures.line_styles import LINES, MARKERS, cycled
from mocapbench.reports.figures.svg import PALETTE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["LINE_WIDTH", "MARKER_SIZE", "draw_points", "finish_axes", "names_collide", "t_interval"]

MARKER_SIZE, LINE_WIDTH = 4.5, 1.0
LOG_RANGE = 20.0
"""Ratio of the largest to the smallest value above which the axis is logarithmic."""


def t_interval(values: pd.Series[float]) -> tuple[float, float]:
    """Return the 95 % interval of the mean by Student's t; the point itself for one value."""
    estimate = FoldMean.of(values.to_list())
    half = estimate.half_width or 0.0
    return estimate.mean - half, estimate.mean + half


def draw_points(
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


def finish_axes(axes: Axes, title: str, values: pd.Series[float], *, tilted: bool) -> None:
    """Label the axes, choose their scale from ``values``, and tilt the names of cases if asked."""
    axes.set(xlabel="", ylabel=title, yscale=_scale(values))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.grid(axis="y", linewidth=0.6)
    axes.tick_params(axis="x", length=0)
    if tilted:
        for label in axes.get_xticklabels():
            label.set(rotation=30, ha="right", rotation_mode="anchor")


def names_collide(names: Sequence[str], width: float) -> bool:
    """Return whether names, at six points a letter, touch side by side in ``width`` inches."""
    return 6.0 * max(map(len, names)) > 72.0 * (width - 0.8) / len(names)


def _scale(values: pd.Series[float]) -> str:
    """Return the scale of the axis: logarithmic where the values span orders of magnitude."""
    positive = values.min() > 0.0
    return "log" if positive and values.max() > LOG_RANGE * values.min() else "linear"
