"""Leave out points of a line that nobody would miss (Ramer 1972; Douglas and Peucker 1973)."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array

__all__ = ["TOLERANCE", "thin_points"]


TOLERANCE = 0.4
"""The largest distance of a point from the line, in pixels.

With the rounding of coordinates no point moves by more than half a pixel.
"""


def thin_points(points: Array) -> Array:
    """Return some of ``points``, whose line passes within `TOLERANCE` of all others.

    Parameters
    ----------
    points : ndarray of shape (N, 2)
        In pixels; rows with NaN, which break the line, stay.
    """
    kept = np.asarray(np.isnan(points).any(axis=1))
    ends = [-1, *np.flatnonzero(kept), len(points)]
    for before, after in pairwise(ends):
        if after - before > 1:
            _keep(points, kept, before + 1, after - 1)
    return np.asarray(points[kept])


def _keep(points: Array, kept: NDArray[np.bool_], first: int, last: int) -> None:
    """Mark what a run needs: its ends, then whatever lies furthest from the line so far."""
    kept[[first, last]] = True
    waiting = [(first, last)]
    while waiting:
        start, end = waiting.pop()
        if end - start < 2:
            continue
        distances = _distances(points[start + 1 : end], points[start], points[end])
        furthest = int(distances.argmax())
        if distances[furthest] > TOLERANCE:
            middle = start + 1 + furthest
            kept[middle] = True
            waiting += [(start, middle), (middle, end)]


def _distances(points: Array, start: Array, end: Array) -> Array:
    """Return the distance of each point from the line between two."""
    along, offsets = end - start, points - start
    length = float(along @ along) or 1.0
    shares = np.clip(offsets @ along / length, 0.0, 1.0)
    return np.asarray(np.hypot(*(offsets - shares[:, None] * along).T))
