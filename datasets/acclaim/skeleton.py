"""Acclaim skeletons: segments, their degrees of freedom and their hierarchy.

Angles are in degrees. Lengths, root translations included, are in the skeleton's own unit, which
is ``1 / length_unit`` inches (the CMU database states ``length 0.45``, so 5.64 cm).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby

__all__ = ["Segment", "Skeleton", "Vector", "format_skeleton"]

Vector = tuple[float, ...]
"""Three numbers."""

_CENTIMETRES_PER_INCH = 2.54


@dataclass(frozen=True)
class Segment:
    """A rigid segment from its parent's end to its own.

    Parameters
    ----------
    name : str
        For example ``lfemur``.
    parent : str
        Name of the segment at whose end this one begins; empty for the root.
    direction : tuple of 3 float
        Unit vector in the rest pose, in global coordinates; zero for the root.
    length : float
        In the skeleton's unit, 0 for the root.
    axis : tuple of 3 float
        Euler angles, in degrees, of the local axes about which the segment rotates.
    order : str
        Order in which rotations are applied, for example ``XYZ``.
    dof : tuple of str
        Degrees of freedom in the order of a motion's values, for example ``("rx", "rz")``.
    """

    name: str
    parent: str
    direction: Vector
    length: float
    axis: Vector
    order: str
    dof: tuple[str, ...]


@dataclass(frozen=True)
class Skeleton:
    """Segments, the root first and every parent before its children.

    Parameters
    ----------
    name : str
        As given in the file.
    length_unit : float
        One unit of length is ``1 / length_unit`` inches.
    segments : tuple of Segment
        In the order of the hierarchy.
    """

    name: str
    length_unit: float
    segments: tuple[Segment, ...]

    @property
    def centimetres_per_unit(self) -> float:
        """Centimetres in one unit of length."""
        return _CENTIMETRES_PER_INCH / self.length_unit

    @property
    def moving(self) -> dict[str, tuple[str, ...]]:
        """Degrees of freedom of each segment that has any, by its name."""
        return {segment.name: segment.dof for segment in self.segments if segment.dof}

    @property
    def parents(self) -> tuple[int, ...]:
        """Index of each segment's parent, -1 for the root."""
        index = {segment.name: i for i, segment in enumerate(self.segments)}
        return tuple(index.get(segment.parent, -1) for segment in self.segments)


def format_skeleton(skeleton: Skeleton) -> str:
    """Return the text of an .asf file; reading it gives the same skeleton."""
    root, *segments = skeleton.segments
    blocks = (
        line for number, segment in enumerate(segments, 1) for line in _block(number, segment)
    )
    lines = (
        ":version 1.10",
        f":name {skeleton.name}",
        ":units",
        f"  length {skeleton.length_unit!r}",
        "  angle deg",
        ":root",
        f"  order {' '.join(root.dof).upper()}",
        f"  axis {root.order}",
        "  position 0 0 0",
        "  orientation 0 0 0",
        ":bonedata",
        *blocks,
        ":hierarchy",
        "  begin",
        *_hierarchy(skeleton),
        "  end",
    )
    return "\n".join(lines) + "\n"


def _block(number: int, segment: Segment) -> Iterator[str]:
    yield "  begin"
    yield f"    id {number}"
    yield f"    name {segment.name}"
    yield f"    direction {_numbers(segment.direction)}"
    yield f"    length {segment.length!r}"
    yield f"    axis {_numbers(segment.axis)} {segment.order}"
    if segment.dof:
        yield f"    dof {' '.join(segment.dof)}"
    yield "  end"


def _hierarchy(skeleton: Skeleton) -> Iterator[str]:
    for parent, children in groupby(skeleton.segments[1:], key=lambda segment: segment.parent):
        yield f"    {parent} {' '.join(child.name for child in children)}"


def _numbers(values: Iterable[float]) -> str:
    return " ".join(map(repr, values))
