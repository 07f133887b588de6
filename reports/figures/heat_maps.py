"""Draw heat maps in nine levels around zero.

The cells of small matrices show their values. In large matrices negative cells are hatched, so that
the sign is visible without colour. Neighbouring cells of one level in a row form one rectangle, and
all rectangles of a level form one path, which keeps a page with many matrices small.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np
from markupsafe import Markup
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.path import Path
from numpy.typing import NDArray

from mocapbench.reports.bundle.heat_maps import HeatMap, HeatMaps
from mocapbench.reports.figures.svg import INK, LEVELS, STYLE, svg_element
from mocapbench.reports.figures.svg_figure import Key, SvgFigure
from mocapbench.reports.text import counted, slug

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["draw", "levels_of"]

Level = NDArray[np.intp]

MOST_WRITTEN = 8
"""Matrices of more rows have no room for their values."""
SIDE, MARGIN = 2.4, 0.9
RECTANGLE = re.compile(r"M (\S+) (\S+)\s+L (\S+) \2\s+L \3 (\S+)\s+L \1 \4\s+z\s*")
"""A rectangle as matplotlib writes it, at twice the necessary length."""
MIDDLE = len(LEVELS) // 2
HATCH: dict[str, Any] = {"facecolor": "none", "edgecolor": INK, "hatch": "/////", "linewidth": 0.0}
LOOK = {**STYLE, "hatch.linewidth": 0.35, "xtick.labelsize": 7, "ytick.labelsize": 7}


def draw(figure: HeatMaps) -> SvgFigure:
    """Return ``figure`` drawn, with nine levels of equal width over ± its limit."""
    prefix = slug(figure.task, figure.title, "drawing")
    hatched = len(figure.labels) > MOST_WRITTEN
    with rc_context(LOOK):
        return SvgFigure(
            figure.title,
            _maps(figure, prefix),
            _legend(figure.limit, hatched, prefix),
            figure.caption,
        )


def levels_of(values: NDArray[np.float64], limit: float) -> Level:
    """Return the level of each value.

    Parameters
    ----------
    values : ndarray
    limit : float

    Returns
    -------
    ndarray of int, of the shape of ``values``
        Levels 0 … 8 have equal width over [−limit, limit]. Values beyond ± ``limit`` belong to the
        outermost levels.
    """
    n_levels = len(LEVELS)
    places = np.floor((values / limit + 1.0) * n_levels / 2.0).astype(np.intp)
    return np.clip(places, 0, n_levels - 1)


def _maps(figure: HeatMaps, prefix: str) -> Markup:
    n_rows = -(-len(figure.maps) // figure.columns)
    width, height = figure.columns * SIDE + MARGIN, n_rows * (SIDE + 0.3) + MARGIN
    canvas = Figure(figsize=(width, height), layout="constrained")
    grid = canvas.subplots(n_rows, figure.columns, squeeze=False, sharex=True, sharey=True)
    for axes in grid.flat[len(figure.maps) :]:
        axes.set_visible(False)
    for axes, heat_map in zip(grid.flat, figure.maps, strict=False):
        _draw_cells(axes, levels_of(heat_map.values, figure.limit))
        _frame(axes, heat_map, figure.labels)
    for axes in grid.flat[max(0, len(figure.maps) - figure.columns) : len(figure.maps)]:
        axes.tick_params(labelbottom=True)
    svg = svg_element(
        canvas,
        prefix,
        role="img",
        aria_label=f"{figure.title}: {counted(len(figure.maps), 'heat map')}",
        style=f"min-width: {width:.2f}in",
    )
    return Markup(RECTANGLE.sub(r"M\1 \2H\3V\4H\1z", svg))


def _draw_cells(axes: Axes, levels: Level) -> None:
    for level, colour in enumerate(LEVELS):
        cells = _rectangles(levels == level)
        axes.add_patch(PathPatch(cells, facecolor=colour, linewidth=0.0, antialiased=False))
    if len(levels) > MOST_WRITTEN:
        axes.add_patch(PathPatch(_rectangles(levels < MIDDLE), **HATCH))


def _rectangles(chosen: NDArray[np.bool_]) -> Path:
    """Return the chosen cells as one path, with a rectangle for each run along a row."""
    steps = np.diff(np.pad(chosen, ((0, 0), (1, 1))).astype(int), axis=1)
    rows, starts = np.nonzero(steps == 1)
    ends = np.nonzero(steps == -1)[1]
    corners = np.stack(
        [
            np.stack([x, y], axis=1)
            for x, y in (
                (starts, rows),
                (ends, rows),
                (ends, rows + 1),
                (starts, rows + 1),
                (starts, rows),
            )
        ],
        axis=1,
    )
    codes = [Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY]
    return Path(corners.reshape(-1, 2).astype(float), np.tile(codes, len(rows)))


def _frame(axes: Axes, heat_map: HeatMap, labels: Sequence[str]) -> None:
    """Name rows and columns, separate groups of one name by lines, and write small matrices out."""
    names, sizes = zip(*((name, len(list(run))) for name, run in groupby(labels)), strict=True)
    ends = np.cumsum(sizes)
    centres = ends - np.asarray(sizes) / 2.0
    axes.set(xlim=(0, len(labels)), ylim=(len(labels), 0), aspect="equal")
    axes.set_xticks(centres, names, rotation=90)
    axes.set_yticks(centres, names)
    axes.tick_params(length=0)
    axes.set_title(heat_map.title, fontsize=9, loc="left")
    for end in ends[:-1]:
        axes.axhline(end, color=INK, linewidth=0.25)
        axes.axvline(end, color=INK, linewidth=0.25)
    if len(labels) <= MOST_WRITTEN:
        for (row, column), value in np.ndenumerate(heat_map.values):
            text = f"{value:z.2f}".replace("-", "−")
            axes.text(column + 0.5, row + 0.5, text, ha="center", va="center", fontsize=7)


def _legend(limit: float, hatched: bool, prefix: str) -> tuple[Key, ...]:
    """Return a key for each level, named by its centre, or by its inner edge if outermost."""
    width = 2.0 * limit / len(LEVELS)
    texts = [_signed(width * (level - MIDDLE)) for level in range(len(LEVELS))]
    edge = width * (MIDDLE - 0.5)
    texts[0], texts[-1] = f"≤ {_signed(-edge)}", f"≥ {_signed(edge)}"
    return tuple(
        Key(text, _swatch(level, hatched and level < MIDDLE, f"{prefix}-key-{level}"))
        for level, text in enumerate(texts)
    )


def _signed(value: float) -> str:
    return f"{value:.2g}".replace("-", "−")


def _swatch(level: int, hatched: bool, prefix: str) -> Markup:
    figure = Figure(figsize=(0.24, 0.16))
    figure.add_artist(Rectangle((0.0, 0.0), 1.0, 1.0, facecolor=LEVELS[level], edgecolor=INK))
    if hatched:
        figure.add_artist(Rectangle((0.0, 0.0), 1.0, 1.0, **HATCH))
    return svg_element(figure, prefix, aria_hidden="true")
