"""Bodies: how the positions of joints follow from the values of a recording."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets import (
    FrameByJointBy3,
    Recording,
    Skeleton,
    integrate_root,
    joint_positions,
    position_channels,
)

__all__ = ["Body", "JointAngles", "JointPositions"]

JointByChannel = NDArray[np.bool_]


class Body(Protocol):
    """Places the joints of a skeleton in space."""

    @property
    def skeleton(self) -> Skeleton:
        """The joints, the root first, and what connects them."""

    def positions(self, *recordings: Recording) -> FrameByJointBy3:
        """Return the joints (N, J, 3) of complete frames, in centimetres; the y axis points up.

        N counts the frames of all recordings, which are one below the other.
        """

    def dependence(self, channels: Sequence[str]) -> JointByChannel:
        """Return which of the channels (D,) the position of each joint depends on, (J, D)."""


@dataclass(frozen=True)
class JointAngles:
    """A body whose recordings hold joint angles: the positions follow by forward kinematics.

    The root's translation is a path, or differences from frame to frame, which are summed up from
    the origin. Degrees of freedom without a channel are in the rest pose.

    Parameters
    ----------
    skeleton : Skeleton
    """

    skeleton: Skeleton

    def positions(self, *recordings: Recording) -> FrameByJointBy3:
        """Return the joints of complete frames; see `Body`.

        Raises
        ------
        ValueError
            If a channel is none of the skeleton's, or an entry is hidden.
        """
        paths = [
            integrate_root(recording) if "root.dtx" in recording.channels else recording
            for recording in recordings
        ]
        return joint_positions(self.skeleton, *paths)

    def dependence(self, channels: Sequence[str]) -> JointByChannel:
        """Return True where the channel is of the joint's segment or of one that carries it."""
        segments = self.skeleton.segments
        owners = [channel.partition(".")[0] for channel in channels]
        depends = np.equal.outer([segment.name for segment in segments], owners)
        for joint, parent in enumerate(self.skeleton.parents[1:], start=1):
            depends[joint] |= depends[parent]
        # The root turns about itself: only its translation moves it.
        depends[0] &= [".t" in channel or ".dt" in channel for channel in channels]
        return depends


@dataclass(frozen=True)
class JointPositions:
    """A body whose recordings hold the coordinates of its joints, as markers on them give them.

    Parameters
    ----------
    skeleton : Skeleton
        Only its joints and their order count, not its lengths.
    """

    skeleton: Skeleton

    def positions(self, *recordings: Recording) -> FrameByJointBy3:
        """Return the joints of complete frames; see `Body`.

        Raises
        ------
        ValueError
            If a coordinate of a joint is missing.
        """
        channels = position_channels(self.skeleton)
        ordered = [recording.select(channels).values for recording in recordings]
        return np.concatenate(ordered).reshape(-1, len(self.skeleton.segments), 3)

    def dependence(self, channels: Sequence[str]) -> JointByChannel:
        """Return True where the channel is a coordinate of the joint."""
        owners = [channel.partition(".")[0] for channel in channels]
        return np.array(
            [[owner == segment.name for owner in owners] for segment in self.skeleton.segments]
        )
