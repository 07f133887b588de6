"""The body of contests of motion prediction: its 38 joints, and where rotations put them.

All people have the offsets of subject 02 of the CMU database, in the unit of its skeletons. The
root's position and rotation are left out: the body stays put and faces one way. Six joints beside
the root never move, and seven coincide with another, so that 25 are left to predict.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.datasets.acclaim.skeleton import Segment, Skeleton
from mocapbench.datasets.kinematics import FrameByJointBy3
from mocapbench.datasets.recording import FrameByChannel

__all__ = [
    "BONES",
    "JOINTS",
    "PARENTS",
    "PREDICTED",
    "REST",
    "ROTATION_CHANNELS",
    "ROTATION_UNITS",
    "coincident_joints",
    "complete_joints",
    "place_rotated_joints",
    "rotation_skeleton",
]


def _read_joints() -> Sequence[Mapping[str, str]]:
    table = Path(__file__).with_name("body.csv").read_text(encoding="utf-8")
    return tuple(csv.DictReader(table.splitlines()))


_JOINTS = _read_joints()
JOINTS = tuple(joint["joint"] for joint in _JOINTS)
"""Names of the 38 joints, the root first and every parent before its children."""
BONES = tuple(joint["bone"] for joint in _JOINTS)
"""By joint, the segment of the CMU database that begins there, empty at the end of a limb."""
PARENTS = tuple(JOINTS.index(joint["parent"]) if joint["parent"] else -1 for joint in _JOINTS)
"""By joint, the index of the one that carries it, -1 for the root."""
PREDICTED = tuple(joint["joint"] for joint in _JOINTS if joint["coincides_with"] == joint["joint"])
"""The 25 joints that move and that no other coincides with before it."""
ROTATION_CHANNELS = tuple(
    f"{name}.{axis}" for name in ("path", *JOINTS) for axis in ("x", "y", "z")
)
"""The 117 columns of a file: the root's position and a rotation vector for each joint."""
ROTATION_UNITS = ("",) * 3 + ("rad",) * (3 * len(JOINTS))

_AXES = ("x", "y", "z")
_OFFSETS = np.array([[float(joint[axis]) for axis in _AXES] for joint in _JOINTS])
REST = np.deg2rad([[float(joint[f"rest_{axis}"]) for axis in _AXES] for joint in _JOINTS])
"""(38, 3) the rotation vectors of the rest pose, which is the first row of every file."""

_CMU_LENGTH_UNIT = 0.45
_STILL = ((0.0, 0.0, 0.0), "XYZ", ())
"""Axis, order and degrees of freedom of a segment whose rotation is given as a vector."""

_NOT_ZERO = 1e-7
"""What the contests' code adds to an angle before it divides by it."""


@cache
def rotation_skeleton() -> Skeleton:
    """Return the joints and what connects them, in the unit of the CMU database's skeletons."""
    lengths = np.linalg.norm(_OFFSETS, axis=1)
    directions = _OFFSETS / np.where(lengths, lengths, 1.0)[:, None]
    segments = tuple(
        Segment(
            joint["joint"], joint["parent"], tuple(map(float, direction)), float(length), *_STILL
        )
        for joint, direction, length in zip(_JOINTS, directions, lengths, strict=True)
    )
    return Skeleton("rotations", _CMU_LENGTH_UNIT, segments)


def place_rotated_joints(values: FrameByChannel) -> FrameByJointBy3:
    """Return the 38 joints (N, 38, 3) of the columns (N, 117) of a file, in the skeleton's unit.

    With x_j the joint, p its parent and G the rotation of the latter, both rows,
    x_j = offset_j G_p + x_p. The rotation of the root is taken to be none.
    """
    vectors = values[:, 3:].reshape(len(values), len(JOINTS), 3)
    own = _rotate(vectors)
    joints, carried = np.zeros_like(vectors), np.empty_like(own)
    carried[:, 0] = np.eye(3)
    for joint, parent in enumerate(PARENTS[1:], start=1):
        joints[:, joint] = _OFFSETS[joint] @ carried[:, parent] + joints[:, parent]
        carried[:, joint] = own[:, joint] @ carried[:, parent]
    return joints


def _rotate(vectors: Array) -> Array:
    """Return the matrices (..., 3, 3) of rotation vectors (..., 3), as the contests' code does."""
    angles = np.linalg.norm(vectors, axis=-1)[..., None, None]
    x, y, z = np.moveaxis(vectors / (angles[..., 0] + _NOT_ZERO), -1, 0)
    zero = np.zeros_like(x)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(*x.shape, 3, 3)
    matrices = np.eye(3) + np.sin(angles) * cross + (1.0 - np.cos(angles)) * (cross @ cross)
    return np.asarray(matrices)


@cache
def coincident_joints() -> NDArray[np.intp]:
    """Return, by joint, the index among `PREDICTED` of the one that it coincides with, or -1."""
    shown = [joint["coincides_with"] for joint in _JOINTS]
    return np.array([PREDICTED.index(name) if name else -1 for name in shown])


@cache
def _fixed_joints() -> FrameByJointBy3:
    """Return the joints (1, 38, 3) where no joint is turned, of which those that never move count.

    The offsets of such joints hang from the root alone.
    """
    return place_rotated_joints(np.zeros((1, 3 + 3 * len(JOINTS))))


def complete_joints(predicted: FrameByJointBy3) -> FrameByJointBy3:
    """Return all joints (N, 38, 3), in the skeleton's unit, of the positions of `PREDICTED`."""
    shown_by = coincident_joints()
    moving = (shown_by >= 0)[:, None]
    return np.where(moving, predicted[:, np.maximum(shown_by, 0)], _fixed_joints())
