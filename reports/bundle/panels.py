"""Panels of curves, as plain values."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Band", "Curve", "Illustration", "Panel"]


@dataclass(frozen=True, eq=False)
class Curve:
    """A line through points.

    Parameters
    ----------
    x, y : ndarray of shape (N,)
        NaN breaks the line.
    group : str
        Name in the legend; all curves of a group share one style.

    Raises
    ------
    ValueError
        If x and y are not vectors of one length.
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
        The group of curves whose style it takes.
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
        Heading, and the quantity along each axis with its unit.
    curves : tuple of Curve
    spatial : bool
        Whether x and y are coordinates in one unit, which are drawn on equal scales.
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
        Heading, and a sentence that explains the figure.
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
