"""Every kind of picture that a report draws, as plain values.

The harness decides which pictures to show; `mocapbench.reports.figures` draws them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByJointBy3

__all__ = ["Axes", "Curve", "HeatMaps", "Illustration", "Motions", "Picture", "Space"]


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

    x: Array
    y: Array
    group: str

    def __post_init__(self) -> None:
        if self.x.ndim != 1 or self.x.shape != self.y.shape:
            raise ValueError(
                f"curve of {self.group!r}: expected as many x as y, "
                f"got shapes {self.x.shape} and {self.y.shape}"
            )


@dataclass(frozen=True, eq=False)
class Axes:
    """One set of axes, with what is drawn in it.

    Parameters
    ----------
    title, x_label, y_label : str
        Heading, and the quantity along each axis with its unit.
    curves : tuple of Curve
    spatial : bool
        Whether x and y are coordinates in one unit, which are drawn on equal scales.
    bands : mapping of str to ndarray of shape (N, 3)
        Areas between two lines, drawn behind the curves of the same group: x, low and high.
    """

    title: str
    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    spatial: bool = False
    bands: Mapping[str, Array] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Illustration:
    """A figure of one task, its axes one below the other.

    Parameters
    ----------
    task : str
        Name of the task's layout.
    title, caption : str
        Heading, and a sentence that explains the figure.
    axes : tuple of Axes
    """

    task: str
    title: str
    caption: str
    axes: tuple[Axes, ...]

    @property
    def groups(self) -> tuple[str, ...]:
        """The groups of all curves, in order of first appearance."""
        curves = (curve for axes in self.axes for curve in axes.curves)
        return tuple(dict.fromkeys(curve.group for curve in curves))


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
    maps : mapping of str to ndarray of shape (M, M)
        By their titles.
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
    maps: Mapping[str, Array]
    limit: float
    columns: int

    def __post_init__(self) -> None:
        shapes = {matrix.shape for matrix in self.maps.values()}
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
class Space:
    """A figure of one task: paths through space, in a cloud of values.

    Parameters
    ----------
    task : str
        Name of the task's layout.
    title, caption : str
        Heading, and a sentence that explains the figure.
    paths : sequence of (str, ndarray of shape (N, 3))
        Lines through points, each with its name in the legend; NaN breaks a line, and all paths of
        one name share one style.
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
    paths: Sequence[tuple[str, Array]]
    cloud: Array
    values: Array
    value_name: str

    def __post_init__(self) -> None:
        if self.cloud.shape != (len(self.values), 3):
            raise ValueError(
                f"space {self.title!r}: expected a cloud of shape {(len(self.values), 3)}, as "
                f"many points as values, got {self.cloud.shape}"
            )


@dataclass(frozen=True, eq=False)
class Motions:
    """A figure of one task: recorded motions and what entrants made of them, to be played.

    The y axis points up, and the ground is at y = 0. Where the body has a front, it faces along x.

    Parameters
    ----------
    task : str
        Name of the task's layout.
    title, caption : str
        Heading, and sentences that explain the figure.
    interval : float
        Seconds from one frame to the next.
    joints : tuple of J str
    parents : tuple of J int
        The joint at the other end of each bone; -1 where there is none.
    hidden : ndarray of bool of shape (T,)
        True at frames of which models did not see everything.
    truths : mapping of str to ndarray of shape (T, J, 3)
        By name, in centimetres.
    motions : mapping of str to ndarray of shape (T, J, 3)
        What each entrant made, in centimetres: best first, as far as they are ranked. The player
        starts with the first.
    beside : str
        The label that it starts with beside the first.
    against : mapping of str to str
        By label, the truth that errors are taken from: ``"truth"`` for those left out.

    Raises
    ------
    ValueError
        If there is no motion, shapes disagree, a position is not finite, a motion is compared
        with a truth or shown beside a motion that is not there, or a joint does not come after its
        parent.
    """

    task: str
    title: str
    caption: str
    interval: float
    joints: tuple[str, ...]
    parents: tuple[int, ...]
    hidden: NDArray[np.bool_]
    truths: Mapping[str, FrameByJointBy3]
    motions: Mapping[str, FrameByJointBy3]
    beside: str
    against: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        shape = (len(self.hidden), len(self.joints), 3)
        positions = [*self.truths.values(), *self.motions.values()]
        shapes = {array.shape for array in positions}
        if not self.motions or shapes != {shape} or not np.isfinite(positions).all():
            raise ValueError(
                f"motions {self.title!r}: expected one motion or more, each of finite positions of "
                f"shape {shape}, got {len(self.motions)} motions and shapes {sorted(shapes)}"
            )
        names = {*self.truths, *self.motions}
        unknown = {self.beside, *map(self.truth_of, self.motions)} - names
        if unknown:
            raise ValueError(
                f"motions {self.title!r}: expected to compare motions and truths of "
                f"{sorted(names)}, got {sorted(unknown)}"
            )
        if len(self.parents) != shape[1] or any(p >= j for j, p in enumerate(self.parents)):
            raise ValueError(
                f"motions {self.title!r}: expected for each of {shape[1]} joints a parent that "
                f"comes before it, got {self.parents}"
            )

    def truth_of(self, label: str) -> str:
        """Return the name of the truth that the errors of ``label`` are taken from."""
        return self.against.get(label, "truth")


Picture = Illustration | HeatMaps | Space | Motions
"""A figure of one task, of any kind."""
