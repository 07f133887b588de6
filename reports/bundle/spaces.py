"""Paths through a three-dimensional space, as plain values."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Path3D", "Space"]


@dataclass(frozen=True, eq=False)
class Path3D:
    """A line through points of space.

    Parameters
    ----------
    points : ndarray of shape (N, 3)
    group : str
        Name in the legend; all paths of a group share one style.
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
        Heading, and a sentence that explains the figure.
    paths : tuple of Path3D
    cloud : ndarray of shape (n, 3)
    values : ndarray of shape (n,)
        One for each point of the cloud. The points of the highest tenth of values are shown.
    value_name : str
        Name of the values in the legend.

    Raises
    ------
    ValueError
        If the cloud and the values differ in length, or the points are not three-dimensional.
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
