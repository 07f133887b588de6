"""The error-bar figure: a point per case and entrant, with a 95 % interval where folds give one.

Markers and line styles distinguish the entrants without colour. Generated motion has separate axes:
its scale differs, and no line joins it to recordings of people.
"""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd
from markupsafe import Markup
from matplotlib import rc_context
from matplotlib.figure import Figure

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.line_styles import (
    LINES,
    MARKERS,
    SMALLEST_SCALE,
    cycled,
    line_swatch,
)
from mocapbench.reports.figures.point_axes import (
    LINE_WIDTH,
    MARKER_SIZE,
    draw_points,
    finish_axes,
    names_collide,
    t_interval,
)
from mocapbench.reports.figures.svg import PALETTE, STYLE, svg_element
from mocapbench.reports.figures.svg_figure import Key, SvgFigure
from mocapbench.reports.text import counted, slug

__all__ = ["error_bars"]

SMALLEST_WIDTH = 4.9
INTERVALS = "mean and 95 % interval over folds (Student’s t). A single fold has no interval."
POINTS = (
    "mean over folds. The folds are overlapping windows of one recording and not independent, "
    "so there is no interval."
)


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
        draw_points(axes, shown, order, places, errorbar)
        finish_axes(axes, title, shown["value"], tilted=names_collide(order, width))
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
        markevery=(1, 2),  # the middle one
    )
