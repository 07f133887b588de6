"""Draw panels of curves."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from mocapbench.reports.bundle.panels import Band, Curve, Illustration, Panel
from mocapbench.reports.figures.axes import BOTTOM, LEFT, TOP, WIDTH, Axes, panels
from mocapbench.reports.figures.fitting import fit_linear_scale
from mocapbench.reports.figures.legend import line_keys
from mocapbench.reports.figures.marks import band, group, polyline
from mocapbench.reports.figures.pictures.thinning import thin_points
from mocapbench.reports.figures.scale import LinearScale
from mocapbench.reports.figures.styles import DrawingStyle, group_styles
from mocapbench.reports.figures.svg_figure import SvgFigure

__all__ = ["draw"]

HEIGHT, WIDE = 150.0, 700.0
"""Of the axes of a panel, and the width of a panel with motion in space, in pixels."""

Styles = Mapping[str, DrawingStyle]


def draw(illustration: Illustration, models: Styles) -> SvgFigure:
    """Return ``illustration`` as a figure, a group of a model's name in the model's style."""
    styles = group_styles(illustration.groups, models)
    drawn = [_panel(panel, styles, illustration.title) for panel in illustration.panels]
    return SvgFigure(illustration.title, panels(drawn), line_keys(styles), illustration.caption)


def _panel(panel: Panel, styles: Styles, title: str) -> Markup:
    axes = _spatial_axes(panel) if panel.spatial else _axes(panel)
    marks = [
        *(group(styles[each.group], _area(each, axes)) for each in panel.bands),
        *(
            group(styles[name], _lines([c for c in panel.curves if c.group == name], axes))
            for name in dict.fromkeys(curve.group for curve in panel.curves)
        ),
    ]
    return axes.draw(marks, ", ".join(filter(None, (title, panel.title))))


def _axes(panel: Panel) -> Axes:
    along = [*(curve.x for curve in panel.curves), *(each.x for each in panel.bands)]
    heights = np.concatenate(
        [*(curve.y for curve in panel.curves), *(np.r_[b.low, b.high] for b in panel.bands)]
    )
    x = fit_linear_scale(np.concatenate(along), LEFT, WIDTH)
    y = fit_linear_scale(heights, TOP + HEIGHT, TOP)
    return Axes(x, y, panel.title, panel.x_label, panel.y_label)


def _spatial_axes(panel: Panel) -> Axes:
    """Return axes of one scale, as high as the curves need."""
    x = fit_linear_scale(np.concatenate([curve.x for curve in panel.curves]), LEFT, WIDE)
    unit = (x.stop - x.start) / (x.high - x.low)
    heights = np.concatenate([curve.y for curve in panel.curves])
    low, high = float(np.nanmin(heights)), float(np.nanmax(heights))
    bottom = TOP + max(unit * (high - low), BOTTOM)
    return Axes(
        x,
        LinearScale(low, low + (bottom - TOP) / unit, bottom, TOP),
        panel.title,
        panel.x_label,
        panel.y_label,
    )


def _area(area: Band, axes: Axes) -> str:
    return band(axes.x.places(area.x), axes.y.places(area.low), axes.y.places(area.high))


def _lines(curves: Iterable[Curve], axes: Axes) -> str:
    """Return curves of one group as one mark."""
    gap = np.full((1, 2), np.nan)
    points = [part for curve in curves for part in (_points(curve, axes), gap)]
    return polyline(*np.concatenate(points).T)


def _points(curve: Curve, axes: Axes) -> NDArray[np.float64]:
    return thin_points(np.stack([axes.x.places(curve.x), axes.y.places(curve.y)], axis=1))
