"""Forward kinematics: the positions of the joints, from the angles, and as channels of their own.

A segment's rotation is stated in its own local frame: with C the rotation of the segment's axis and
M that of its degrees of freedom, it turns by C M C⁻¹ within its parent, and its end lies at the
parent's end plus ``length * direction`` so turned (Acclaim ASF/AMC specification).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.acclaim.skeleton import Segment, Skeleton
from mocapbench.datasets.recording import FrameByChannel, Frames, Recording

__all__ = ["FrameByJointBy3", "joint_positions", "joint_trajectories", "position_channels"]

FrameByJointBy3 = NDArray[np.float64]
"""(N, J, 3) centimetres."""
Rotations = NDArray[np.float64]
"""(3, 3, N) matrices, the frames last, so that products of all of them are fast."""

_TRANSLATION = ("tx", "ty", "tz")
_NO_TURN = np.eye(3)[:, :, np.newaxis]


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
    root, *segments = skeleton.segments
    curves = _curves(skeleton, recordings)
    ends = {root.name: np.stack([curves[f"{root.name}.{dof}"] for dof in _TRANSLATION])}
    axes = _axes(skeleton.segments)
    rotations = {root.name: _rotation(root, axes[0], curves)}
    for segment, axis in zip(segments, axes[1:], strict=True):
        rotation = _then(_rotation(segment, axis, curves), rotations[segment.parent])
        bone = segment.length * np.asarray(segment.direction)
        rotations[segment.name] = rotation
        ends[segment.name] = ends[segment.parent] + np.einsum("ijn,j->in", rotation, bone)
    return np.stack(list(ends.values())).transpose(2, 0, 1) * skeleton.centimetres_per_unit


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


def _curves(skeleton: Skeleton, recordings: Sequence[Recording]) -> dict[str, Frames]:
    """Return the curves of the degrees of freedom that have a channel, and of the root's path."""
    known = {f"{segment.name}.{dof}" for segment in skeleton.segments for dof in segment.dof}
    for recording in recordings:
        _check(recording, known)
    names = [f"{skeleton.segments[0].name}.{dof}" for dof in _TRANSLATION]
    names += sorted({name for recording in recordings for name in recording.channels} - {*names})
    stacked = np.concatenate([_columns(names, recording) for recording in recordings])
    return dict(zip(names, stacked.T, strict=True))


def _check(recording: Recording, known: Collection[str]) -> None:
    unknown = [name for name in recording.channels if name not in known]
    if unknown or not recording.visible.all():
        raise ValueError(
            f"recording {recording.name!r}: expected complete frames of the skeleton's degrees of "
            f"freedom, got {np.count_nonzero(~recording.visible)} hidden entries and "
            f"the unknown channels {unknown}"
        )


def _columns(names: Sequence[str], recording: Recording) -> FrameByChannel:
    """Return the columns of these names, zero where the recording has no such channel."""
    columns = np.zeros((len(recording.times), len(names)))
    columns[:, [names.index(name) for name in recording.channels]] = recording.values
    return columns


def _axes(segments: Sequence[Segment]) -> NDArray[np.float64]:
    """Return C of every segment, (S, 3, 3, 1)."""
    axes = map(_about, "XYZ", np.transpose([segment.axis for segment in segments]))
    return np.moveaxis(reduce(_then, axes), 2, 0)[..., np.newaxis]


def _rotation(segment: Segment, axis: Rotations, curves: Mapping[str, Frames]) -> Rotations:
    """Return C M C⁻¹ at every frame; at one frame if the segment stays at rest."""
    names = [f"{segment.name}.r{turn.lower()}" for turn in segment.order]
    pairs = zip(segment.order, names, strict=True)
    turns = [_about(turn, curves[name]) for turn, name in pairs if name in curves]
    moved = reduce(_then, turns or [_NO_TURN])
    return _then(_then(axis.transpose(1, 0, 2), moved), axis)


def _about(axis: str, degrees: Frames) -> Rotations:
    """Return the rotations about a fixed axis."""
    radians, about = np.deg2rad(degrees), "XYZ".index(axis)
    first, second = (about + 1) % 3, (about + 2) % 3
    rotations = np.zeros((3, 3, len(radians)))
    rotations[about, about] = 1.0
    rotations[first, first] = rotations[second, second] = np.cos(radians)
    rotations[second, first] = np.sin(radians)
    rotations[first, second] = -rotations[second, first]
    return rotations


def _then(first: Rotations, second: Rotations) -> Rotations:
    """Return the rotations that turn by ``first``, and then by ``second``, about fixed axes.

    Without BLAS, whose last bits depend on the machine: generated recordings follow from them.
    """
    return np.asarray(np.einsum("ijn,jkn->ikn", second, first))
