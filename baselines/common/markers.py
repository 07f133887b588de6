"""Which channels are the coordinates of markers or joints."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["marker_places", "markers_of", "points_of"]

_COORDINATE = re.compile(r"(.+)[._: -]([xyz])", re.IGNORECASE)
_NO_LENGTHS = frozenset(["deg", "rad", "n", "nm", "n.m", "nmm", "n.mm", "w"])
"""Units of angles, forces, moments and powers, in lower case, also of those per kilogram."""


def markers_of(channels: Sequence[str], units: Sequence[str]) -> Mapping[str, tuple[int, ...]]:
    """Return the places of the coordinates x, y and z of each marker among D channels, by its name.

    They are named such as ``LKNE.x``, ``LKNE.y`` and ``LKNE.z``, as in C3D and TRC files and for
    joints in `mocapbench.datasets.joint_trajectories`, or ``LKNE_X``, and have no unit of angles or
    forces.

    Examples
    --------
    >>> markers_of(("force", "LKNE.x", "LKNE.z", "LKNE.y", "LANK.x"), ("N", *["mm"] * 4))
    {'LKNE': (1, 3, 2)}
    """
    points = points_of(channels, units)
    return {marker: places for marker, places in points.items() if len(places) == len("xyz")}


def points_of(channels: Sequence[str], units: Sequence[str]) -> Mapping[str, tuple[int, ...]]:
    """Return the places of the coordinates x, y and, if it has one, z of each point, by its name.

    Examples
    --------
    >>> points_of(("nose.x", "nose.y", "LANK.x"), ("px", "px", "mm"))
    {'nose': (0, 1)}
    """
    places: dict[str, dict[str, int]] = defaultdict(dict)
    for place, (channel, unit) in enumerate(zip(channels, units, strict=True)):
        found = _COORDINATE.fullmatch(channel)
        if found and unit.lower().removesuffix("/kg") not in _NO_LENGTHS:
            places[found[1]][found[2].lower()] = place
    return {
        point: tuple(axes[axis] for axis in "xyz" if axis in axes)
        for point, axes in places.items()
        if {"x", "y"} <= axes.keys()
    }


def marker_places(channels: Sequence[str], units: Sequence[str]) -> NDArray[np.intp]:
    """Return the places of the coordinates of M markers among D channels (M, 3), as `markers_of`.

    Examples
    --------
    >>> marker_places(("force", "LKNE.x", "LKNE.z", "LKNE.y"), ("N", *["mm"] * 3))
    array([[1, 3, 2]])
    """
    return np.array([*markers_of(channels, units).values()], dtype=np.intp).reshape(-1, 3)
