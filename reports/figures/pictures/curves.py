"""Draw curves and areas in their axes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from markupsafe import Markup

from mocapbench.reports.bundle.pictures import Axes, Curve, Illustration
from mocapbench.reports.figures.axes import BOTTOM, LEFT, TOP, WIDTH, draw_axes, panels
from mocapbench.reports.figures.marks import band, group, polyline
from mocapbench.reports.figures.pictures.thinning import thin_points
from mocapbench.reports.figures.scale import LinearScale, Scale, fit_linear_scale
from mocapbench.reports.figures.styles import DrawingStyle, group_styles
from mocapbench.reports.figures.svg_figure import SvgFigure, line_keys

__all__ = ["draw"]

HEIGHT, WIDE = 150.0, 700.0
"""Of axes, and the width of axes with motion in space, in pixels."""

Styles = Mapping[str, DrawingStyle]


def draw(illustration: Illustration, models: Styles) -> SvgFigure:
    """Return ``illustration`` as a figure, a group of a model's name in the model's style."""
    styles = group_styles(illustration.groups, models)
    drawn = [_draw_axes(axes, styles, illustration.title) for axes in illustration.axes]
    return SvgFigure(illustration.title, panels(drawn), line_keys(styles), illustration.caption)


def _draw_axes(axes: Axes, styles: Styles, title: str) -> Markup:
    x, y = _spatial_scales(axes) if axes.spatial else _scales(axes)
    groups = dict.fromkeys(curve.group for curve in axes.curves)
    marks = [
        *(
            group(styles[name], band(x.places(at), y.places(low), y.places(high)))
            for name, (at, low, high) in ((name, area.T) for name, area in axes.bands.items())
        ),
        *(
            group(styles[name], _lines([c for c in axes.curves if c.group == name], x, y))
            for name in groups
        ),
    ]
    label = ", ".join(filter(None, (title, axes.title)))
    return draw_axes((x, y), axes.title, (axes.x_label, axes.y_label), marks, label)


def _scales(axes: Axes) -> tuple[Scale, Scale]:
    areas = axes.bands.values()
    along = [*(curve.x for curve in axes.curves), *(area[:, 0] for area in areas)]
    heights = [*(curve.y for curve in axes.curves), *(area[:, 1:].ravel() for area in areas)]
    return (
        fit_linear_scale(np.concatenate(along), LEFT, WIDTH),
        fit_linear_scale(np.concatenate(heights), TOP + HEIGHT, TOP),
    )


def _spatial_scales(axes: Axes) -> tuple[Scale, Scale]:
    """Return scales of one unit, as high as the curves need."""
    x = fit_linear_scale(np.concatenate([curve.x for curve in axes.curves]), LEFT, WIDE)
    unit = (x.stop - x.start) / (x.high - x.low)
    heights = np.concatenate([curve.y for curve in axes.curves])
    low, high = float(np.nanmin(heights)), float(np.nanmax(heights))
    bottom = TOP + max(unit * (high - low), BOTTOM)
    return x, LinearScale(low, low + (bottom - TOP) / unit, bottom, TOP)


def _lines(curves: Iterable[Curve], x: Scale, y: Scale) -> str:
    """Return curves of one group as one mark."""
    gap = np.full((1, 2), np.nan)
    points = [
        part
        for curve in curves
        for part in (thin_points(np.stack([x.places(curve.x), y.places(curve.y)], axis=1)), gap)
    ]
    return polyline(*np.concatenate(points).T)
