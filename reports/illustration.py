"""Illustrations: panels of curves that show what entrants did, as plain values.

Whoever fills a bundle decides what is worth seeing; this package draws it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Curve", "Illustration", "Panel"]


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
class Panel:
    """One set of axes.

    Parameters
    ----------
    title, x_label, y_label : str
        What it shows, and what is along its axes, with the unit.
    curves : tuple of Curve
    spatial : bool
        Whether x and y are places, in one unit, rather than two quantities.
    """

    title: str
    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    spatial: bool = False


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
