"""Draw paths through a cloud of points: two views as marks, and a canvas that a script turns."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Callable, Mapping

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.basics.words import format_count
from mocapbench.reports.bundle.pictures import Space
from mocapbench.reports.figures.axes import WIDTH, panels
from mocapbench.reports.figures.marks import dot, group, polyline, svg, text
from mocapbench.reports.figures.pictures.thinning import thin_points
from mocapbench.reports.figures.styles import DrawingStyle, group_styles
from mocapbench.reports.figures.svg_figure import Key, SvgFigure, key, line_keys
from mocapbench.reports.resources import dump_json

__all__ = ["draw", "projection"]

SIDE = 300.0
VIEWS = ((22.0, -60.0), (22.0, 30.0))
"""Elevation and azimuth of each view, in degrees."""
SHOWN = 0.9
"""Points of the cloud whose values are below this quantile are left out."""
CLOUD = range(5, 9)
"""The levels of the cloud."""
_REACH = 32767

Styles = Mapping[str, DrawingStyle]
Paths = list[tuple[str, Array]]


def draw(space: Space, models: Styles) -> SvgFigure:
    """Return ``space`` as a figure: its paths, and the highest tenth of its cloud."""
    styles = group_styles(tuple(dict.fromkeys(name for name, _ in space.paths)), models)
    cloud, levels = _select_points(space)
    scaled = _fit_axes(space, cloud)
    paths = [(name, scaled(points)) for name, points in space.paths]
    views = [
        svg(
            SIDE,
            SIDE,
            _describe_view(space, view),
            _draw_view(paths, scaled(cloud), levels, styles, view),
        )
        for view in VIEWS
    ]
    turning = _canvas(space, paths, scaled(cloud), levels, styles)
    legend = (*line_keys(styles), *_level_keys(space))
    return SvgFigure(space.title, panels([turning, *views]), legend, space.caption)


def _describe_view(space: Space, view: tuple[float, float]) -> str:
    sides = f"elevation {view[0]:g}°, azimuth {view[1]:g}°"
    return f"{space.title}: {format_count(len(space.paths), 'path')}, {sides}"


def projection(elevation: float, azimuth: float) -> Array:
    """Return the map (3, 2) from space to right and up, seen from two angles in degrees."""
    up, around = np.deg2rad([elevation, azimuth])
    right = [-np.sin(around), np.cos(around), 0.0]
    above = [-np.sin(up) * np.cos(around), -np.sin(up) * np.sin(around), np.cos(up)]
    return np.array([right, above]).T


def _edges(space: Space) -> Array:
    """Return the lower ends of the levels, of equal width over the highest tenth of values."""
    low, high = np.quantile(space.values, SHOWN), space.values.max()
    return np.linspace(low, high, len(CLOUD) + 1)[:-1]


def _select_points(space: Space) -> tuple[Array, NDArray[np.intp]]:
    """Return the points of the cloud that are shown, and their levels."""
    places = np.searchsorted(_edges(space), space.values, side="right") - 1
    return space.cloud[places >= 0], places[places >= 0] + CLOUD.start


def _fit_axes(space: Space, cloud: Array) -> Callable[[Array], Array]:
    """Return the map of each axis onto [−1, 1]."""
    points = np.concatenate([cloud, *(points for _, points in space.paths)])
    low, high = np.nanmin(points, axis=0), np.nanmax(points, axis=0)
    reach = np.where(high > low, high - low, 1.0) / 2.0
    return lambda of: np.asarray((of - (low + high) / 2.0) / reach)


def _draw_view(
    paths: Paths,
    cloud: Array,
    levels: NDArray[np.intp],
    styles: Styles,
    view: tuple[float, float],
) -> list[str]:
    """Return the marks of one view."""
    onto = projection(*view) * [1.0, -1.0]
    places = SIDE / 2.0 + cloud @ onto * SIDE / 3.6
    return [
        *_tripod(onto),
        *(_points(places[levels == level], level) for level in CLOUD),
        *(
            group(styles[name], polyline(*thin_points(SIDE / 2.0 + points @ onto * SIDE / 3.6).T))
            for name, points in paths
        ),
    ]


def _tripod(onto: Array) -> list[str]:
    """Return the axes, from the corner of least values."""
    corner = SIDE / 2.0 - onto.sum(axis=0) * SIDE / 3.6
    ends = corner + 2.0 * onto * SIDE / 3.6
    lines = (np.stack([corner, end], axis=1) for end in ends)
    names = zip(ends, ("x₁", "x₂", "x₃"), strict=True)
    return [
        *(polyline(xs, ys, "axis") for xs, ys in lines),
        *(text(x, y - 3.0, name) for (x, y), name in names),
    ]


def _points(places: Array, level: int) -> str:
    commands = "".join(f"M{x:.0f} {y:.0f}h0" for x, y in places)
    return f'<path class="cloud c{level}" d="{commands}"/>'


def _canvas(
    space: Space, paths: Paths, cloud: Array, levels: NDArray[np.intp], styles: Styles
) -> Markup:
    """Return a canvas that a script draws and turns, hidden without one."""
    data = {
        "cloud": _encode_points(cloud),
        "levels": levels.tolist(),
        "paths": [
            [styles[name].hue, styles[name].label, _encode_points(points)] for name, points in paths
        ],
        "view": VIEWS[0],
    }
    return Markup(
        '<canvas class="space" hidden tabindex="0" role="img" width="{0}" height="{0}" '
        'aria-label="{1}: drag, or press arrows, to turn" data-space="{2}"></canvas>'
    ).format(int(WIDTH), space.title, dump_json(data, separators=(",", ":")))


def _encode_points(points: Array) -> str:
    """Return points of [−1, 1] as 16-bit numbers; NaN as the least of them."""
    whole = np.nan_to_num(np.rint(points * _REACH), nan=-_REACH - 1.0)
    return b64encode(whole.astype("<i2").tobytes()).decode()


def _level_keys(space: Space) -> list[Key]:
    return [
        key(f"{space.value_name} ≥ {edge:.3g}", DrawingStyle(f"c{level}"), dot(14.0, 7.0))
        for level, edge in zip(CLOUD, _edges(space), strict=True)
    ]
