"""Rotation vectors from the joint angles of the CMU database.

The contests' files were made from the database's own: by bone the rotation within the parent, its
Euler angles rounded to four decimals of a degree, and the rotation vector of its inverse, since
points are rows there. Computed in double precision, one rotation in fifty differs from theirs by
up to 2e-6 radians, which no score shows.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from mocapbench.basics.arrays import Array
from mocapbench.datasets.acclaim.skeleton import Segment, Skeleton
from mocapbench.datasets.recording import FrameByChannel, Recording
from mocapbench.datasets.rotations.body import (
    BONES,
    REST,
    ROTATION_CHANNELS,
    ROTATION_UNITS,
)

__all__ = ["rotations_of"]

_DECIMALS = 4  # of a degree, and of the root's path


def rotations_of(recording: Recording, skeleton: Skeleton) -> Recording:
    """Return a recording of joint angles as the contests have it.

    Parameters
    ----------
    recording : Recording
        N frames of the channels of the CMU database.
    skeleton : Skeleton
        Its own.

    Returns
    -------
    Recording
        N + 1 frames of ``ROTATION_CHANNELS``. The first is the rest pose, at the root's first
        position, one frame before the others.

    Raises
    ------
    ValueError
        If the skeleton lacks one of the database's segments.
    """
    segments = {segment.name: segment for segment in skeleton.segments}
    lacking = [bone for bone in BONES if bone and bone not in segments]
    if lacking:
        raise ValueError(
            f"recording {recording.name!r}: expected the segments of the CMU database, got none of "
            f"{lacking}; name a recording of its skeletons"
        )
    vectors = [_rotate_bone(segments.get(bone), recording) for bone in BONES]
    path = np.round(recording.select([f"root.t{axis}" for axis in "xyz"]).values, _DECIMALS)
    moving = np.hstack([path, *vectors])
    rest = np.concatenate([path[0], REST.ravel()])
    interval = (recording.times[-1] - recording.times[0]) / (len(recording.times) - 1)
    times = np.concatenate([recording.times[:1] - interval, recording.times])
    return Recording(
        recording.name, times, np.vstack([rest, moving]), ROTATION_CHANNELS, ROTATION_UNITS
    )


def _rotate_bone(segment: Segment | None, recording: Recording) -> FrameByChannel:
    """Return the rotation vectors (N, 3) of a segment; none of the end of a limb."""
    if segment is None:
        return np.zeros((len(recording.times), 3))
    angles, is_root = _list_angles(segment, recording), segment.parent == ""
    return _round_root(angles) if is_root else _round_rotation(_rotate_segment(segment, angles))


def _list_angles(segment: Segment, recording: Recording) -> Array:
    """Return the angles (N, 3) about x, y and z in degrees, zero where it cannot turn."""
    columns = {name: column for column, name in enumerate(recording.channels)}
    names = [f"{segment.name}.r{axis}" for axis in "xyz"]
    still = np.zeros(len(recording.times))
    found = [recording.values[:, columns[name]] if name in columns else still for name in names]
    return np.column_stack(found)


def _rotate_segment(segment: Segment, angles: Array) -> Rotation:
    axis = Rotation.from_euler("xyz", segment.axis, degrees=True)
    return axis * Rotation.from_euler("xyz", angles, degrees=True) * axis.inv()


def _round_rotation(rotation: Rotation) -> FrameByChannel:
    degrees = np.round(rotation.as_euler("ZYX", degrees=True), _DECIMALS)
    return _list_vectors(Rotation.from_euler("ZYX", degrees, degrees=True))


def _round_root(angles: Array) -> FrameByChannel:
    """Return the root's rotation vectors: its angles as they are, taken in another order."""
    degrees = np.round(angles[:, [2, 0, 1]], _DECIMALS)
    return _list_vectors(Rotation.from_euler("ZXY", degrees, degrees=True))


def _list_vectors(rotation: Rotation) -> FrameByChannel:
    return np.asarray(rotation.inv().as_rotvec())
