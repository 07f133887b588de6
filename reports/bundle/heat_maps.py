"""Square matrices shown as colours, as plain values."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["HeatMap", "HeatMaps"]


@dataclass(frozen=True, eq=False)
class HeatMap:
    """A square matrix, as colours.

    Parameters
    ----------
    title : str
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
        Heading, and a sentence that explains the figure.
    labels : tuple of str
        Names of the M rows, which are also those of the columns. Neighbours may share a name.
    maps : tuple of HeatMap
    limit : float
        End of the colour scale, which runs from −limit to limit. Larger values share its end.
    columns : int
        How many maps are drawn side by side.

    Raises
    ------
    ValueError
        If there is no map, a map has not one row and column per label, or the limit is not
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
        shapes = {heat_map.values.shape for heat_map in self.maps}
        if shapes != {(len(self.labels), len(self.labels))}:
            raise ValueError(
                f"heat maps {self.title!r}: expected matrices with {len(self.labels)} rows and "
                f"columns, as many as labels, got shapes {sorted(shapes)}"
            )
        if not self.limit > 0.0:
            raise ValueError(
                f"heat maps {self.title!r}: expected a positive limit, got {self.limit:g}"
            )
