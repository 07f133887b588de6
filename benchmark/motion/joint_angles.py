"""Joint angles as the motions of a skeleton: AMC with its ASF, and BVH."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.spatial.transform import Rotation

from mocapbench.datasets import (
    FrameByChannel,
    Motion,
    Recording,
    Segment,
    Skeleton,
    format_motion,
    frame_rate,
    integrate_root,
)

__all__ = ["amc_text", "bvh_text"]

Vectors = FrameByChannel


def amc_text(skeleton: Skeleton, recording: Recording) -> str:
    """Return an .amc file of every degree of freedom; those without a channel are at rest.

    The root's path is summed from the origin where the recording has its differences. The format
    does not state the frame rate.
    """
    segments = tuple(skeleton.moving)
    names = [f"{segment}.{dof}" for segment in segments for dof in skeleton.moving[segment]]
    return format_motion(Motion(skeleton, segments, _values(recording, names)))


def bvh_text(skeleton: Skeleton, recording: Recording) -> str:
    """Return a .bvh file in centimetres whose joints are where the skeleton's segments begin.

    A segment's rotation C M C⁻¹ within its parent (see `joint_positions`) is stated as Euler
    angles about z, then the turned y, then the turned x. The rest pose is that of the skeleton, so
    that an offset is the bone of the segment before.
    """
    root = skeleton.segments[0]
    scale = skeleton.centimetres_per_unit
    path = scale * _values(recording, [f"root.t{axis}" for axis in "xyz"])
    angles = [_euler(segment, recording) for segment in (root, *_depth_first(skeleton, root.name))]
    rows = np.column_stack([path, *angles]).tolist()
    return "\n".join(
        (
            "HIERARCHY",
            *_joint(skeleton, root, np.zeros(3), 0),
            "MOTION",
            f"Frames: {len(rows)}",
            f"Frame Time: {1.0 / frame_rate(recording)!r}",
            *(" ".join(map(repr, row)) for row in rows),
            "",
        )
    )


def _values(recording: Recording, names: list[str]) -> FrameByChannel:
    """Return the named channels, with the root's path, and 0 where there is no such channel."""
    moved = integrate_root(recording) if "root.dtx" in recording.channels else recording
    curves = dict(zip(moved.channels, moved.values.T, strict=True))
    rest = np.zeros(len(moved.times))
    return np.column_stack([curves.get(name, rest) for name in names])


def _euler(segment: Segment, recording: Recording) -> Vectors:
    """Return the angles about z, y and x in degrees (N, 3), without jumps of 360°."""
    names = [f"{segment.name}.r{axis.lower()}" for axis in segment.order]
    moved = Rotation.from_euler(segment.order.lower(), _values(recording, names), degrees=True)
    axis = Rotation.from_euler("xyz", segment.axis, degrees=True)
    angles = (axis * moved * axis.inv()).as_euler("ZYX")
    return np.asarray(np.rad2deg(np.unwrap(angles, axis=0)))


def _children(skeleton: Skeleton, name: str) -> list[Segment]:
    return [segment for segment in skeleton.segments if segment.parent == name]


def _depth_first(skeleton: Skeleton, name: str) -> Iterator[Segment]:
    """Yield the segments below one, in the order of the hierarchy's lines."""
    for child in _children(skeleton, name):
        yield child
        yield from _depth_first(skeleton, child.name)


def _joint(skeleton: Skeleton, segment: Segment, offset: Vectors, depth: int) -> Iterator[str]:
    """Yield the lines of a joint that begins at ``offset`` from the one before, and those below."""
    kind, position = ("JOINT", "") if depth else ("ROOT", "Xposition Yposition Zposition ")
    inner = "  " * (depth + 1)
    bone = segment.length * skeleton.centimetres_per_unit * np.asarray(segment.direction)
    yield f"{'  ' * depth}{kind} {segment.name}"
    yield f"{'  ' * depth}{{"
    yield f"{inner}OFFSET {_words(offset)}"
    yield f"{inner}CHANNELS {3 if depth else 6} {position}Zrotation Yrotation Xrotation"
    for child in _children(skeleton, segment.name):
        yield from _joint(skeleton, child, bone, depth + 1)
    if not _children(skeleton, segment.name):
        yield from (
            f"{inner}End Site",
            f"{inner}{{",
            f"{inner}  OFFSET {_words(bone)}",
            f"{inner}}}",
        )
    yield f"{'  ' * depth}}}"


def _words(vector: Vectors) -> str:
    return " ".join(map(repr, vector.tolist()))
