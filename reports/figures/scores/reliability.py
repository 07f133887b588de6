"""Reliability: how often truths fall into predicted intervals, against how often they should."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from markupsafe import Markup

from mocapbench.basics.words import format_count
from mocapbench.metrics.base import Direction
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.figures.axes import LEFT, TOP, WIDTH, draw_axes, panels
from mocapbench.reports.figures.marks import dot, group, polyline
from mocapbench.reports.figures.scale import LinearScale
from mocapbench.reports.figures.scores.best import mean_values
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure, line_keys

__all__ = ["coverage_curves", "reliability"]

FEWEST = 2
_DIAGONAL = DrawingStyle("hr", 1)

Curve = dict[float, float]


def reliability(results: TaskResults, styles: Mapping[str, DrawingStyle]) -> SvgFigure | None:
    """Return nominal against empirical coverage of each model; None with fewer than two levels."""
    curves = coverage_curves(results)
    if not curves:
        return None
    legend = line_keys({label: styles[label] for label in curves})
    return SvgFigure("Reliability", panels([_panel(curves, styles)]), legend, "")


def coverage_curves(results: TaskResults) -> dict[str, Curve]:
    """Return the empirical coverage by nominal level of each label that has two or more levels."""
    curves: dict[str, Curve] = {}
    for nominal, metric in sorted(_levels(results).items()):
        for label, share in mean_values(results, metric).items():
            curves.setdefault(label, {})[nominal] = share
    return {label: curve for label, curve in curves.items() if len(curve) >= FEWEST}


def _levels(results: TaskResults) -> dict[float, str]:
    """Return the metrics of coverage by their nominal level."""
    scored = set(results.scores["metric"])
    return {
        info.target: name
        for name, info in results.metrics.items()
        if name in scored
        and info.of_distribution
        and info.direction is Direction.TARGET
        and info.target is not None
    }


def _panel(curves: Mapping[str, Curve], styles: Mapping[str, DrawingStyle]) -> Markup:
    lowest = min(min(*curve, *curve.values()) for curve in curves.values())
    low = np.floor(10.0 * lowest) / 10.0
    x = LinearScale(low, 1.0, LEFT, WIDTH)
    y = LinearScale(low, 1.0, TOP + WIDTH - LEFT, TOP)
    ends = np.array([low, 1.0])
    marks = [
        group(_DIAGONAL, polyline(x.places(ends), y.places(ends), "dotted")),
        *(
            group(styles[n], *_marks(curve, x, y, styles[n]), title=n)
            for n, curve in curves.items()
        ),
    ]
    label = f"Nominal against empirical coverage of {format_count(len(curves), 'model')}"
    return draw_axes((x, y), "", ("nominal coverage", "empirical coverage"), marks, label)


def _marks(curve: Curve, x: LinearScale, y: LinearScale, style: DrawingStyle) -> list[str]:
    at, heights = x.places(np.array(list(curve))), y.places(np.array(list(curve.values())))
    points = zip(at, heights, strict=True)
    return [polyline(at, heights), *(dot(*point, style.shape) for point in points)]
