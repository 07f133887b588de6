"""Acclaim motions: the values of a skeleton's degrees of freedom, frame by frame."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np

from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.recording import FrameByChannel, Recording

__all__ = ["FRAME_RATE", "Motion", "format_motion"]

FRAME_RATE = 120.0
"""Frames per second of the CMU database; the files do not state it."""

_UNITS = {"r": "deg", "t": ""}


@dataclass(frozen=True, eq=False)
class Motion:
    """The values of an .amc file, unchanged except that angles are in degrees.

    Root translations keep the skeleton's unit of length, in which the papers' errors are stated;
    only `joint_positions` converts to centimetres.

    Parameters
    ----------
    skeleton : Skeleton
        The skeleton that moves.
    segments : tuple of str
        Every segment of the skeleton that has degrees of freedom, in the order of the file.
    values : ndarray of shape (N, D)
        One column per degree of freedom: degrees, or the skeleton's unit of length.

    Raises
    ------
    ValueError
        If the segments are not those of the skeleton with degrees of freedom, or the values have
        another shape or are not finite.
    """

    skeleton: Skeleton
    segments: tuple[str, ...]
    values: FrameByChannel

    def __post_init__(self) -> None:
        moving = self.skeleton.moving
        if sorted(self.segments) != sorted(moving):
            raise ValueError(f"expected the segments {sorted(moving)}, got {self.segments}")
        values = np.array(self.values, dtype=np.float64)
        if values.ndim != 2 or values.shape[1] != len(self.channels):
            raise ValueError(
                f"expected values of shape (frames, {len(self.channels)}), got {values.shape}"
            )
        if not np.isfinite(values).all():
            raise ValueError("expected finite values, got NaN or infinity")
        values.setflags(write=False)
        object.__setattr__(self, "values", values)

    @property
    def channels(self) -> tuple[str, ...]:
        """Names of the columns, such as ``lfemur.rx``."""
        moving = self.skeleton.moving
        return tuple(f"{name}.{dof}" for name in self.segments for dof in moving[name])

    def recording(self, name: str) -> Recording:
        """Return all channels at `FRAME_RATE`, from time 0; units are ``"deg"`` or ``""``."""
        units = tuple(_UNITS[channel.rpartition(".")[2][0]] for channel in self.channels)
        times = np.arange(len(self.values)) / FRAME_RATE
        return Recording(name, times, self.values, self.channels, units)


def format_motion(motion: Motion) -> str:
    """Return the text of an .amc file; reading it gives exactly the same values."""
    return "\n".join((":FULLY-SPECIFIED", ":DEGREES", *_frames(motion))) + "\n"


def _frames(motion: Motion) -> Iterator[str]:
    moving = motion.skeleton.moving
    for number, row in enumerate(motion.values.tolist(), 1):
        yield str(number)
        numbers = iter(map(repr, row))
        for name in motion.segments:
            yield " ".join((name, *islice(numbers, len(moving[name]))))
