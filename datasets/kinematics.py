"""Forward kinematics: the positions of the joints, from the angles, and as channels of their own.

A segment's rotation is stated in its own local frame: with C the rotation of the segment's axis and
M that of its degrees of freedom, it turns by C M C⁻¹ within its parent, and its end lies at the
parent's end plus ``length * direction`` so turned (Acclaim ASF/AMC specification).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from mocapbench.datasets.acclaim.skeleton import Segment, Skeleton
from mocapbench.datasets.recording import FrameByChannel, Frames, Recording

__all__ = ["FrameByJointBy3", "joint_positions", "joint_trajectories", "position_channels"]

FrameByJointBy3 = NDArray[np.float64]
"""(N, J, 3) centimetres."""


def joint_positions(skeleton: Skeleton, *recordings: Recording) -> FrameByJointBy3:
    """Return the end of every segment in centimetres, in the order of ``skeleton.segments``.

    The root's end is the root joint itself. ``skeleton.parents`` gives the joint at the other end
    of each bone.

    Parameters
    ----------
    skeleton : Skeleton
        Its degrees of freedom are the names of the channels.
    *recordings : Recording
        N complete frames in all. Degrees of freedom without a channel are zero: the rest pose.

    Returns
    -------
    ndarray of shape (N, J, 3)
        The recordings one below the other. One call for many is faster than a call for each.

    Raises
    ------
    ValueError
        If a channel is not a degree of freedom of the skeleton, or an entry is hidden.
    """
    names = tuple(f"{segment.name}.{dof}" for segment in skeleton.segments for dof in segment.dof)
    stacked = np.concatenate([_curves(names, recording) for recording in recordings])
    curves = dict(zip(names, stacked.T, strict=True))
    root, *segments = skeleton.segments
    translation = np.column_stack([curves[f"{root.name}.{dof}"] for dof in ("tx", "ty", "tz")])
    ends = {root.name: translation}
    rotations = {root.name: _rotation(root, curves)}
    for segment in segments:
        rotation = rotations[segment.parent] * _rotation(segment, curves)
        bone = segment.length * np.asarray(segment.direction)
        rotations[segment.name] = rotation
        ends[segment.name] = ends[segment.parent] + rotation.apply(bone)
    return np.stack(list(ends.values()), axis=1) * skeleton.centimetres_per_unit


def position_channels(skeleton: Skeleton) -> tuple[str, ...]:
    """Return the names of the coordinates of every joint, such as ``lfemur.x``."""
    return tuple(f"{segment.name}.{axis}" for segment in skeleton.segments for axis in "xyz")


def joint_trajectories(skeleton: Skeleton, recording: Recording) -> Recording:
    """Return the recording of the joints' coordinates in centimetres, as markers on them give it.

    Parameters
    ----------
    skeleton : Skeleton
        Of J joints.
    recording : Recording
        N complete frames; see `joint_positions`.

    Returns
    -------
    Recording
        N frames of the 3 J `position_channels`; the y axis points up.

    Raises
    ------
    ValueError
        As `joint_positions`.

    Examples
    --------
    >>> from mocapbench.datasets import joint_trajectories, open_archive
    >>> archive = open_archive()
    >>> walk, skeleton = archive.recording("gait:01_01"), archive.skeleton("gait:01_01")
    >>> markers = joint_trajectories(skeleton, walk)
    >>> markers.values.shape, markers.channels[0], markers.units[0]
    ((331, 93), 'root.x', 'cm')
    """
    positions = joint_positions(skeleton, recording)
    channels = position_channels(skeleton)
    values = positions.reshape(len(recording.times), -1)
    return Recording(recording.name, recording.times, values, channels, ("cm",) * len(channels))


def _curves(names: Sequence[str], recording: Recording) -> FrameByChannel:
    """Return the curves of the degrees of freedom of these names."""
    unknown = [name for name in recording.channels if name not in names]
    if unknown or not recording.visible.all():
        raise ValueError(
            f"recording {recording.name!r}: expected complete frames of the skeleton's degrees of "
            f"freedom, got {np.count_nonzero(~recording.visible)} hidden entries and "
            f"the unknown channels {unknown}"
        )
    curves = np.zeros((len(recording.times), len(names)))
    curves[:, [names.index(name) for name in recording.channels]] = recording.values
    return curves


def _rotation(segment: Segment, curves: dict[str, Frames]) -> Rotation:
    """Return C M C⁻¹ at every frame.

    Matrices would multiply faster, but by BLAS, whose last bits depend on the machine: generated
    recordings are the same on all.
    """
    rest = np.zeros_like(curves["root.tx"])
    angles = np.column_stack(
        [curves.get(f"{segment.name}.r{axis.lower()}", rest) for axis in segment.order]
    )
    # Lower case: about fixed axes, in the order of their names, as in the Acclaim format.
    moved = Rotation.from_euler(segment.order.lower(), angles, degrees=True)
    axis = Rotation.from_euler("xyz", segment.axis, degrees=True)
    return axis * moved * axis.inv()
