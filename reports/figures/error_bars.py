"""The error-bar figure: a point per case and entrant, with a 95 % interval where folds give one.

Markers and line styles tell the entrants apart without colour. The legend is text of the page with
a swatch for each entrant, so that it wraps on a narrow screen while the drawing scales. Generated
motion has axes of its own: no line leads to it from recordings of people, and scales differ.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeVar

import pandas as pd
import seaborn as sns
from markupsafe import Markup
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mocapbench.reports.analysis.results import Estimate, TaskResults
from mocapbench.reports.bundle.bundle import CaseLayout
from mocapbench.reports.figures.svg import PALETTE, STYLE, element
from mocapbench.reports.tables.base import counted, slug
from mocapbench.reports.tables.scores import case_name

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["ErrorBars", "Key", "error_bars", "t_interval"]

MARKERS = ["o", "s", "^", "D", "v", "P", "X", "<", ">", "p"]
LINES: list[Literal["-", "--", ":", "-."]] = ["-", "--", ":", "-."]
MARKER_SIZE, LINE_WIDTH = 4.5, 1.0
LOG_RANGE = 20.0
SMALLEST_WIDTH = 4.9
SMALLEST_SCALE = 0.7
"""A page narrower than the drawing shrinks it so far and then scrolls it."""
INTERVALS = "mean and 95 % interval over folds (Student’s t), of which one fold has none."
POINTS = (
    "mean over folds, which are overlapping windows of one recording: "
    "not independent draws, so there is no interval."
)


LookT = TypeVar("LookT", bound=str)


@dataclass(frozen=True)
class Key:
    """One entry of the legend."""

    label: str
    swatch: Markup


@dataclass(frozen=True)
class ErrorBars:
    """The drawing as an SVG element, its legend, and what the points and bars are."""

    svg: Markup
    legend: tuple[Key, ...]
    caption: str


def t_interval(values: pd.Series[float]) -> tuple[float, float]:
    """Return the 95 % interval of the mean by Student's t; the point itself for one value."""
    estimate = Estimate.of(values.to_list())
    half = estimate.half_width or 0.0
    return estimate.mean - half, estimate.mean + half


def error_bars(results: TaskResults, metric: str) -> ErrorBars | None:
    """Return the figure of ``metric``; None where there is no score."""
    data = results.scores[results.scores["metric"] == metric]
    scored, prefix = set(data["label"]), slug(results.layout.name, metric, "figure")
    places = {label: i for i, label in enumerate(results.layout.labels) if label in scored}
    if not places:
        return None
    with rc_context(STYLE):
        return ErrorBars(
            _drawing(results, metric, data, places, prefix),
            tuple(Key(label, _swatch(i, f"{prefix}-key-{i}")) for label, i in places.items()),
            INTERVALS if results.layout.independent_folds else POINTS,
        )


def _drawing(
    results: TaskResults, metric: str, data: pd.DataFrame, places: dict[str, int], prefix: str
) -> Markup:
    title, drawn = results.metrics[metric].title, set(data["case"])
    cases = [case for case in results.cases if case.name in drawn]
    names = {case.name: case_name(case) for case in cases}
    orders = _apart(cases)
    widths = _widths(orders)
    figure = Figure(figsize=(sum(widths), 3.4), layout="constrained")
    row = figure.subplots(1, len(orders), squeeze=False, width_ratios=widths)[0]
    errorbar = t_interval if results.layout.independent_folds else None
    named = data.assign(case=data["case"].map(names))
    for axes, order, width in zip(row, orders, widths, strict=True):
        shown = named[named["case"].isin(order)]
        _draw(axes, shown, order, places, errorbar)
        _finish(axes, title, shown["value"], tilted=_collide(order, width))
    return element(
        figure,
        prefix,
        role="img",
        aria_label=f"{title} of {counted(len(places), 'entrant')} in {counted(len(cases), 'case')}",
        style=f"min-width: {SMALLEST_SCALE * sum(widths):.2f}in",
    )


def _apart(cases: Sequence[CaseLayout]) -> list[list[str]]:
    """Return the names of the cases on recordings and of those on generated motion, if any."""
    sets = [[case for case in cases if case.synthetic is made] for made in (False, True)]
    return [[case_name(case) for case in each] for each in sets if each]


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
    """Draw one series per label; its place in the task's labels fixes how it looks everywhere."""
    sns.pointplot(
        data=data,
        x="case",
        y="value",
        hue="label",
        order=order,
        hue_order=list(places),
        palette=[_cycled(PALETTE, place) for place in places.values()],
        markers=[_cycled(MARKERS, place) for place in places.values()],
        linestyles=[_cycled(LINES, place) for place in places.values()],
        dodge=0.6 if len(places) > 1 else False,
        errorbar=errorbar,
        legend=False,
        markersize=MARKER_SIZE,
        linewidth=LINE_WIDTH,
        err_kws={"linewidth": 1.4},
        ax=axes,
    )


def _cycled(looks: Sequence[LookT], place: int) -> LookT:
    return looks[place % len(looks)]


def _finish(axes: Axes, title: str, values: pd.Series[float], *, tilted: bool) -> None:
    axes.set(xlabel="", ylabel=title, yscale=_scale(values))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.grid(axis="y", linewidth=0.6)
    axes.tick_params(axis="x", length=0)
    if tilted:
        for label in axes.get_xticklabels():
            label.set(rotation=30, ha="right", rotation_mode="anchor")


def _collide(names: Sequence[str], width: float) -> bool:
    """Whether names of about six points a letter would touch, side by side in ``width`` inches."""
    return 6.0 * max(map(len, names)) > 72.0 * (width - 0.8) / len(names)


def _scale(values: pd.Series[float]) -> str:
    """Errors that span orders of magnitude are read on a logarithmic axis."""
    positive = values.min() > 0.0
    return "log" if positive and values.max() > LOG_RANGE * values.min() else "linear"


def _swatch(place: int, prefix: str) -> Markup:
    """Return the line and marker of the label at ``place``."""
    figure = Figure(figsize=(0.34, 0.14))
    line = Line2D(
        [0.0, 0.5, 1.0],
        [0.5, 0.5, 0.5],
        color=_cycled(PALETTE, place),
        marker=_cycled(MARKERS, place),
        linestyle=_cycled(LINES, place),
        markersize=MARKER_SIZE,
        linewidth=LINE_WIDTH,
        markeredgewidth=0.75 * LINE_WIDTH,  # as seaborn does
        markevery=[1],
    )
    figure.add_artist(line)
    return element(figure, prefix, aria_hidden="true")
