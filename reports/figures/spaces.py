"""Draw paths through a cloud of points, seen from two sides."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from markupsafe import Markup
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mocapbench.reports.bundle.spaces import Space
from mocapbench.reports.figures.line_styles import LINES, line_swatch
from mocapbench.reports.figures.svg import LEVELS, PALETTE, STYLE, svg_element
from mocapbench.reports.figures.svg_figure import Key, SvgFigure
from mocapbench.reports.text import counted, slug

if TYPE_CHECKING:
    from mpl_toolkits.mplot3d import Axes3D

__all__ = ["draw"]

SIDE = 2.9
VIEWS = ((22, -60), (22, 30))
"""Elevation and azimuth of each view, in degrees."""
SHOWN = 0.9
"""Points of the cloud whose values are below this quantile are left out."""
CLOUD = LEVELS[5:]
MARK: dict[str, Any] = {"s": 14.0, "marker": "o", "linewidths": 0.0, "depthshade": False}


def draw(space: Space) -> SvgFigure:
    """Return ``space`` as a figure: its paths, and the highest tenth of its cloud."""
    prefix = slug(space.task, space.title, "drawing")
    groups = tuple(dict.fromkeys(path.group for path in space.paths))
    styles = {group: _style(place) for place, group in enumerate(groups)}
    with rc_context(STYLE):
        svg = _views(space, styles, prefix)
        return SvgFigure(space.title, svg, _legend(space, styles, prefix), space.caption)


def _views(space: Space, styles: dict[str, dict[str, Any]], prefix: str) -> Markup:
    figure = Figure(figsize=(SIDE * len(VIEWS), SIDE))
    for place, (elevation, azimuth) in enumerate(VIEWS, start=1):
        axes: Axes3D = figure.add_subplot(1, len(VIEWS), place, projection="3d")
        axes.view_init(elevation, azimuth)
        _draw_cloud(axes, space)
        for path in space.paths:
            axes.plot(*path.points.T, **styles[path.group])
        _frame(axes)
    figure.subplots_adjust(left=0.0, right=1.0, bottom=0.04, top=1.0, wspace=0.02)
    return svg_element(
        figure,
        prefix,
        role="img",
        aria_label=f"{space.title}: {counted(len(space.paths), 'path')}, from two sides",
        style=f"min-width: {SIDE * len(VIEWS):.2f}in",
    )


def _style(place: int) -> dict[str, Any]:
    return {"color": PALETTE[place], "linestyle": LINES[place], "linewidth": 1.2}


def _draw_cloud(axes: Axes3D, space: Space) -> None:
    edges = _edges(space)
    levels = np.clip(np.searchsorted(edges, space.values, side="right") - 1, -1, len(CLOUD) - 1)
    for level, colour in enumerate(CLOUD):
        axes.scatter(*space.cloud[levels == level].T, color=colour, alpha=0.35, **MARK)


def _edges(space: Space) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Return the lower ends of the levels, of equal width over the highest tenth of values."""
    low, high = np.quantile(space.values, SHOWN), space.values.max()
    return np.linspace(low, high, len(CLOUD) + 1)[:-1]


def _frame(axes: Axes3D) -> None:
    for axis, name in zip((axes.xaxis, axes.yaxis, axes.zaxis), ("x₁", "x₂", "x₃"), strict=True):
        axis.set_pane_color((0.0, 0.0, 0.0, 0.0))
        axis.set_ticklabels([])
        axis.set_label_text(name)
        axis.labelpad = -12.0


def _legend(space: Space, styles: dict[str, dict[str, Any]], prefix: str) -> tuple[Key, ...]:
    paths = [
        Key(group, line_swatch(f"{prefix}-key-{place}", **style))
        for place, (group, style) in enumerate(styles.items())
    ]
    levels = [
        Key(f"{space.value_name} ≥ {edge:.2g}", _dot(colour, f"{prefix}-level-{place}"))
        for place, (edge, colour) in enumerate(zip(_edges(space), CLOUD, strict=True))
    ]
    return (*paths, *levels)


def _dot(colour: str, prefix: str) -> Markup:
    figure = Figure(figsize=(0.16, 0.16))
    figure.add_artist(Line2D([0.5], [0.5], color=colour, marker="o", linestyle="none"))
    return svg_element(figure, prefix, aria_hidden="true")
