"""Illustrations: panels of curves, and heat maps, that show what entrants did, as plain values.

Whoever fills a bundle decides what is worth seeing; this package draws it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Band",
    "Curve",
    "HeatMap",
    "HeatMaps",
    "Illustration",
    "Panel",
    "Path3D",
    "Picture",
    "Space",
]


@dataclass(frozen=True, eq=False)
class Curve:
    """A line through points.

    Parameters
    ----------
    x, y : ndarray of shape (N,)
        NaN breaks the line.
    group : str
        What the legend calls it; all curves of a group look alike.

    Raises
    ------
    ValueError
        If there are not as many x as y.
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    group: str

    def __post_init__(self) -> None:
        if self.x.ndim != 1 or self.x.shape != self.y.shape:
            raise ValueError(
                f"curve of {self.group!r}: expected as many x as y, "
                f"got shapes {self.x.shape} and {self.y.shape}"
            )


@dataclass(frozen=True, eq=False)
class Band:
    """The area between two curves.

    Parameters
    ----------
    x, low, high : ndarray of shape (N,)
    group : str
        The group of curves that it belongs to and looks like.
    """

    x: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    group: str


@dataclass(frozen=True, eq=False)
class Panel:
    """One set of axes.

    Parameters
    ----------
    title, x_label, y_label : str
        What it shows, and what is along its axes, with the unit.
    curves : tuple of Curve
    spatial : bool
        Whether x and y are places, in one unit, rather than two quantities.
    bands : tuple of Band
        Drawn behind the curves.
    """

    title: str
    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    spatial: bool = False
    bands: tuple[Band, ...] = ()


@dataclass(frozen=True, eq=False)
class Illustration:
    """A figure of one task, its panels one below the other.

    Parameters
    ----------
    task : str
        Name of the task's layout.
    title, caption : str
        Heading, and what is to be seen.
    panels : tuple of Panel
    """

    task: str
    title: str
    caption: str
    panels: tuple[Panel, ...]

    @property
    def groups(self) -> tuple[str, ...]:
        """The groups of all curves, in order of first appearance."""
        curves = (curve for panel in self.panels for curve in panel.curves)
        return tuple(dict.fromkeys(curve.group for curve in curves))


@dataclass(frozen=True, eq=False)
class HeatMap:
    """A square matrix, as colours.

    Parameters
    ----------
    title : str
        What it is.
    values : ndarray of shape (M, M)
    """

    title: str
    values: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class HeatMaps:
    """A figure of one task: matrices of the same rows and columns, on one scale.

    Parameters
    ----------
    task : str
        Name of the task's layout.
    title, caption : str
        Heading, and what is to be seen.
    labels : tuple of str
        Names of the M rows, which are those of the columns; neighbours may share one.
    maps : tuple of HeatMap
    limit : float
        The size of a value that the scale still tells from smaller ones.
    columns : int
        How many maps stand side by side.

    Raises
    ------
    ValueError
        If there is no map, one that is not as large as the labels say, or the limit is not
        positive.
    """

    task: str
    title: str
    caption: str
    labels: tuple[str, ...]
    maps: tuple[HeatMap, ...]
    limit: float
    columns: int

    def __post_init__(self) -> None:
        shapes = {each.values.shape for each in self.maps}
        if shapes != {(len(self.labels), len(self.labels))}:
            raise ValueError(
                f"heat maps {self.title!r}: expected matrices with {len(self.labels)} rows and "
                f"columns, as many as labels, got shapes {sorted(shapes)}"
            )
        if not self.limit > 0.0:
            raise ValueError(
                f"heat maps {self.title!r}: expected a positive limit, got {self.limit:g}"
            )


@dataclass(frozen=True, eq=False)
class Path3D:
    """A line through points of space.

    Parameters
    ----------
    points : ndarray of shape (N, 3)
    group : str
        What the legend calls it; all paths of a group look alike.
    """

    points: NDArray[np.float64]
    group: str


@dataclass(frozen=True, eq=False)
class Space:
    """A figure of one task: paths through space, in a cloud of values.

    Parameters
    ----------
    task : str
        Name of the task's layout.
    title, caption : str
        Heading, and what is to be seen.
    paths : tuple of Path3D
    cloud : ndarray of shape (n, 3)
    values : ndarray of shape (n,)
        One for each point of the cloud; the highest tenth of them are shown.
    value_name : str
        What the values are.

    Raises
    ------
    ValueError
        If the cloud has not as many points as there are values.
    """

    task: str
    title: str
    caption: str
    paths: tuple[Path3D, ...]
    cloud: NDArray[np.float64]
    values: NDArray[np.float64]
    value_name: str

    def __post_init__(self) -> None:
        if self.cloud.shape != (len(self.values), 3):
            raise ValueError(
                f"space {self.title!r}: expected a cloud of shape {(len(self.values), 3)}, as "
                f"many points as values, got {self.cloud.shape}"
            )


Picture = Illustration | HeatMaps | Space
"""A figure of one task, of any kind."""
