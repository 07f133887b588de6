"""The cells of a heat map: levels around zero, drawn as few rectangles.

Neighbouring cells of one level in a row form one rectangle, and all rectangles of a level form one
path, which keeps a page with many matrices small.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy.typing import NDArray

from mocapbench.reports.figures.svg import INK, LEVELS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["HATCH", "MIDDLE", "MOST_WRITTEN", "draw_cells", "levels_of", "rectangles"]

Level = NDArray[np.intp]

MOST_WRITTEN = 8
"""Matrices with more rows have no room for their values."""
MIDDLE = len(LEVELS) // 2
"""The level around zero."""
HATCH: dict[str, Any] = {"facecolor": "none", "edgecolor": INK, "hatch": "/////", "linewidth": 0.0}


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


def draw_cells(axes: Axes, levels: Level) -> None:
    """Colour the cells of a matrix by their levels, and hatch negative ones of large matrices."""
    for level, colour in enumerate(LEVELS):
        cells = rectangles(levels == level)
        axes.add_patch(PathPatch(cells, facecolor=colour, linewidth=0.0, antialiased=False))
    if len(levels) > MOST_WRITTEN:
        axes.add_patch(PathPatch(rectangles(levels < MIDDLE), **HATCH))


def rectangles(chosen: NDArray[np.bool_]) -> Path:
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
