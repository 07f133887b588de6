"""Draw heat maps around zero.

Small matrices are marks that show their values. Large ones are a canvas, which a script colours
from the data; it hatches negative cells, so that the sign is visible without colour.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping, Sequence
from itertools import groupby

import numpy as np
from markupsafe import Markup, escape
from numpy.typing import NDArray

from mocapbench.basics.words import format_count
from mocapbench.reports.bundle.pictures import HeatMaps
from mocapbench.reports.figures.axes import panels
from mocapbench.reports.figures.marks import horizontal, rectangle, squares, svg, text, vertical
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import Key, SvgFigure, key
from mocapbench.reports.text import MINUS, number

__all__ = ["MOST_WRITTEN", "draw", "levels_of"]

MOST_WRITTEN = 8
"""Matrices with more rows have no room for their values."""
N_LEVELS, MIDDLE = 9, 4
LEFT, TOP, SIDE, BOTTOM = 72.0, 20.0, 260.0, 72.0
_INK = DrawingStyle("ht")

Level = NDArray[np.intp]


def draw(figure: HeatMaps, models: Mapping[str, DrawingStyle]) -> SvgFigure:
    """Return ``figure`` drawn; its colours run over ± its limit."""
    del models  # a matrix is in no model's colour
    drawn = [_map(figure, title) for title in figure.maps]
    return SvgFigure(figure.title, panels(drawn), _legend(figure.limit), figure.caption)


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
    places = np.floor((values / limit + 1.0) * N_LEVELS / 2.0).astype(np.intp)
    return np.clip(places, 0, N_LEVELS - 1)


def _map(figure: HeatMaps, title: str) -> Markup:
    values = figure.maps[title]
    written = len(figure.labels) <= MOST_WRITTEN
    cells = _cells(values, figure.limit) if written else []
    canvas = Markup() if written else _canvas(values, figure.limit)
    label = f"{figure.title}, {title}: {_describe_matrix(figure.labels, values)}"
    marks = [text(LEFT, 13.0, title, "title"), *cells, *_names(figure.labels)]
    drawing = svg(LEFT + SIDE + 1.0, TOP + SIDE + BOTTOM, label, marks)
    return Markup('<div class="map">{}{}</div>').format(canvas, drawing)


def _describe_matrix(labels: Sequence[str], values: NDArray[np.float64]) -> str:
    ends = f"{values.min():.2g} to {values.max():.2g}".replace("-", MINUS)
    return f"{format_count(len(labels), 'row')} and as many columns, {ends}"


def _canvas(values: NDArray[np.float64], limit: float) -> Markup:
    """Return a canvas with a byte for each value, 127 at the limit."""
    shares = np.clip(values / limit, -1.0, 1.0)
    data = b64encode(np.rint(127.0 * shares).astype(np.int8).tobytes()).decode()
    return Markup('<canvas class="matrix" data-rows="{}" data-cells="{}"></canvas>').format(
        len(values), data
    )


def _cells(values: NDArray[np.float64], limit: float) -> list[str]:
    """Return the cells, those of a level as one mark, and the value in each."""
    levels, side = levels_of(values, limit), SIDE / len(values)
    corners = {level: np.argwhere(levels == level)[:, ::-1] * side for level in range(N_LEVELS)}
    return [
        *(
            squares([(LEFT + x, TOP + y) for x, y in places], side, f"cell l{level}")
            for level, places in corners.items()
            if len(places)
        ),
        *(
            text(
                LEFT + (column + 0.5) * side,
                TOP + (row + 0.5) * side + 4.0,
                number(float(value), 2),
                "middle name",
            )
            for (row, column), value in np.ndenumerate(values)
        ),
    ]


def _names(labels: Sequence[str]) -> list[str]:
    """Return the names of rows and columns, neighbours of one name as one, apart by lines."""
    names, sizes = zip(*((name, len(list(run))) for name, run in groupby(labels)), strict=True)
    side = SIDE / len(labels)
    ends = np.cumsum(sizes) * side
    centres = ends - np.asarray(sizes) * side / 2.0
    return [
        *(text(LEFT - 5.0, TOP + y + 4.0, n, "end") for n, y in zip(names, centres, strict=True)),
        *(_draw_column_name(LEFT + x + 4.0, n) for n, x in zip(names, centres, strict=True)),
        *(horizontal(LEFT, LEFT + SIDE, TOP + y, "edge") for y in (0.0, *ends)),
        vertical((LEFT + x for x in (0.0, *ends)), TOP, TOP + SIDE, "edge"),
    ]


def _draw_column_name(x: float, name: str) -> str:
    place = f"translate({x:.1f} {TOP + SIDE + 6.0:.1f}) rotate(-90)"
    return f'<text class="end" transform="{place}">{escape(name)}</text>'


def _legend(limit: float) -> tuple[Key, ...]:
    """Return a key for each of nine levels, named by its centre, or its inner edge if outermost."""
    width = 2.0 * limit / N_LEVELS
    texts = [_format_value(width * (level - MIDDLE)) for level in range(N_LEVELS)]
    edge = width * (MIDDLE - 0.5)
    texts[0], texts[-1] = f"≤ {_format_value(-edge)}", f"≥ {_format_value(edge)}"
    return tuple(
        key(name, _INK, rectangle(0.5, 1.5, 27.0, 11.0, f"cell l{level}"))
        for level, name in enumerate(texts)
    )


def _format_value(value: float) -> str:
    return f"{value:.2g}".replace("-", MINUS)
