"""Draw heat maps in nine levels around zero.

The cells of small matrices show their values. In large matrices negative cells are hatched, so that
the sign is visible without colour.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np
from markupsafe import Markup
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from mocapbench.reports.bundle.heat_maps import HeatMap, HeatMaps
from mocapbench.reports.figures.cells import HATCH, MIDDLE, MOST_WRITTEN, draw_cells, levels_of
from mocapbench.reports.figures.svg import INK, LEVELS, STYLE, svg_element
from mocapbench.reports.figures.svg_figure import Key, SvgFigure
from mocapbench.reports.text import counted, slug

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["draw"]

SIDE, MARGIN = 2.4, 0.9
RECTANGLE = re.compile(r"M (\S+) (\S+)\s+L (\S+) \2\s+L \3 (\S+)\s+L \1 \4\s+z\s*")
"""A rectangle as matplotlib writes it, at twice the necessary length."""
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


def _maps(figure: HeatMaps, prefix: str) -> Markup:
    n_rows = -(-len(figure.maps) // figure.columns)
    width, height = figure.columns * SIDE + MARGIN, n_rows * (SIDE + 0.3) + MARGIN
    canvas = Figure(figsize=(width, height), layout="constrained")
    grid = canvas.subplots(n_rows, figure.columns, squeeze=False, sharex=True, sharey=True)
    for axes in grid.flat[len(figure.maps) :]:
        axes.set_visible(False)
    for axes, heat_map in zip(grid.flat, figure.maps, strict=False):
        draw_cells(axes, levels_of(heat_map.values, figure.limit))
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
