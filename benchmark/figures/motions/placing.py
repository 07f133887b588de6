"""Places the joints of several motions at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np

from mocapbench.datasets import FrameByChannel, FrameByJointBy3, Recording, Skeleton

__all__ = ["PlacesJoints", "on_the_spot", "place_joints"]


class PlacesJoints(Protocol):
    """What a player needs of a `Body`."""

    @property
    def skeleton(self) -> Skeleton:
        """The joints, the root first, and what connects them."""

    def positions(self, recording: Recording) -> FrameByJointBy3:
        """Return the joints (N, J, 3) of complete frames, in centimetres; the y axis points up."""


def place_joints(
    body: PlacesJoints, like: Recording, motions: Sequence[FrameByChannel]
) -> list[FrameByJointBy3]:
    """Return the joints of each motion, (N, J, 3) in centimetres.

    Forward kinematics costs a few calls a joint, however many frames there are. So the motions are
    placed as one long recording. A path that is summed from differences starts anew with each.

    Parameters
    ----------
    body : PlacesJoints
    like : Recording
        With the channels of the motions.
    motions : sequence of ndarray (N, D)
    """
    values = np.concatenate(motions)
    joined = replace(like, times=np.arange(float(len(values))), values=values)
    parts = np.split(body.positions(joined), len(motions))
    summed = "root.dtx" in like.channels
    return [part - part[0, 0] if summed else part for part in parts]


def on_the_spot(positions: FrameByJointBy3) -> FrameByJointBy3:
    """Return joints (N, J, 3) without the root's path on the floor."""
    return positions - positions[:, :1] * [1.0, 0.0, 1.0]
