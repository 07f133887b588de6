"""Motions set on the ground and turned so that they are seen from the side."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets import FrameByJointBy3

__all__ = ["side_view"]

_UP = np.array([0.0, 1.0, 0.0])


def side_view(
    truth: FrameByJointBy3, made: FrameByJointBy3, joints: Sequence[str]
) -> tuple[FrameByJointBy3, FrameByJointBy3]:
    """Return the truth and what was made of it, both moved and turned alike.

    The lowest point of the truth is at y = 0. The truth faces along x on average, and z is to its
    right. It faces at right angles to the line from its right joints to their left counterparts,
    as ``rfemur`` and ``lfemur``; a body without counterparts is not turned.

    Parameters
    ----------
    truth, made : ndarray of shape (N, J, 3)
        The y axis points up.
    joints : sequence of J str
    """
    ground, rotation = truth[..., 1].min() * _UP, _face_x_axis(truth, joints)
    return (truth - ground) @ rotation.T, (made - ground) @ rotation.T


def _face_x_axis(truth: FrameByJointBy3, joints: Sequence[str]) -> NDArray[np.float64]:
    """Return the rotation (3, 3) about the y axis that takes the front to the x axis."""
    pairs = [
        (joints.index(name), joints.index(f"r{name[1:]}"))
        for name in joints
        if name.startswith("l") and f"r{name[1:]}" in joints
    ]
    if not pairs:
        return np.eye(3)
    left, right = np.array(pairs).T
    to_the_left = (truth[:, left] - truth[:, right]).mean(axis=(0, 1))
    x, _, z = np.cross(to_the_left, _UP)
    cosine, sine = np.array([x, z]) / (np.hypot(x, z) or 1.0)
    return np.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]])
