"""Motions of one body as positions of its joints, as plain values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets import FrameByJointBy3

__all__ = ["Motion", "Motions"]


@dataclass(frozen=True, eq=False)
class Motion:
    """What one entrant made.

    Parameters
    ----------
    label : str
        The entrant.
    positions : ndarray of shape (T, J, 3)
        The joints, in centimetres.
    against : str
        Name of the truth that its error is taken from.
    """

    label: str
    positions: FrameByJointBy3
    against: str = "truth"


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
    motions : tuple of Motion
        Best first, as far as they are ranked. The player starts with the first.
    beside : str
        The label that it starts with beside the first.

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
    motions: tuple[Motion, ...]
    beside: str

    def __post_init__(self) -> None:
        shape = (len(self.hidden), len(self.joints), 3)
        positions = [*self.truths.values(), *(motion.positions for motion in self.motions)]
        shapes = {array.shape for array in positions}
        if not self.motions or shapes != {shape} or not np.isfinite(positions).all():
            raise ValueError(
                f"motions {self.title!r}: expected one motion or more, each of finite positions of "
                f"shape {shape}, got {len(self.motions)} motions and shapes {sorted(shapes)}"
            )
        names = {*self.truths, *(motion.label for motion in self.motions)}
        unknown = {self.beside, *(motion.against for motion in self.motions)} - names
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
