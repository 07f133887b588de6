"""Stretches of recordings as in-betweening on LaFAN1 has them, as recordings of quaternions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.lafan1.unit_quaternions import (
    invert_quaternions,
    keep_signs,
    multiply_quaternions,
    quaternions_of_angles,
    rotate_vectors,
)
from mocapbench.datasets.recording import Recording

__all__ = ["N_PAST", "Take", "cut_windows", "offsets_of", "split_takes"]

N_PAST = 10
"""Frames that are seen before a gap; the body faces one way at the last of them."""

Take = tuple[Array, Array]
"""The root's places (..., 3), and the rotations (..., J, 4) of joints within their parents."""


def offsets_of(skeleton: Skeleton) -> Array:
    """Return the offset (J, 3) of each joint from the one that carries it, in the rest pose."""
    return np.array([np.multiply(s.direction, s.length) for s in skeleton.segments])


def split_takes(recording: Recording, skeleton: Skeleton) -> Iterator[Take]:
    """Yield the parts of a recording between pauses, as quaternions.

    Parameters
    ----------
    recording : Recording
        With the channels of a BVH file: translations of the root, and angles of each joint in the
        order in which they are applied.
    skeleton : Skeleton
        Its joints.
    """
    steps = np.diff(recording.times)
    ends = np.flatnonzero(steps > 2.0 * np.median(steps)) + 1
    for frames in np.split(np.arange(len(recording.times)), ends):
        part = recording.frames(frames)
        root = part.select([f"{skeleton.segments[0].name}.t{axis}" for axis in "xyz"]).values
        rotations = [_rotations_of(part, segment.name) for segment in skeleton.segments]
        yield root, np.stack(rotations, axis=1)


def _rotations_of(recording: Recording, joint: str) -> Array:
    """Return the rotations (N, 4) of a joint within its parent."""
    channels = [name for name in recording.channels if name.startswith(f"{joint}.r")]
    angles = recording.select(channels).values
    return keep_signs(quaternions_of_angles(angles, ["xyz".index(name[-1]) for name in channels]))


def cut_windows(takes: Sequence[Take], width: int, step: int) -> Take:
    """Return windows of takes (B, ``width``, ...), in the middle and facing one way.

    They begin every ``step`` frames. As the public code has it, one that would end with the take
    is left out. The mean of the root's path on the floor is taken out of each, and the body turned
    about the vertical, y, until the root's y axis points along x at the last frame before the gap.
    """
    root, rotations = (
        np.concatenate([_cut_stretches(take[part], width, step) for take in takes])
        for part in (0, 1)
    )
    middle = root.mean(axis=1, keepdims=True) * [1.0, 0.0, 1.0]
    back = invert_quaternions(_headings(rotations[:, N_PAST - 1, 0]))[:, np.newaxis]
    turned = multiply_quaternions(back, rotations[:, :, 0])
    rest = rotations[:, :, 1:]
    centred = rotate_vectors(back, root - middle)
    return centred, np.concatenate([turned[:, :, np.newaxis], rest], axis=2)


def _cut_stretches(values: Array, width: int, step: int) -> Array:
    """Return stretches (B, ``width``, ...) of values (N, ...)."""
    starts = range(0, max(len(values) - width, 0), step)
    frames = np.arange(width) + np.reshape(starts, (-1, 1)).astype(int)
    return np.asarray(values[frames])


def _headings(rotations: Array) -> Array:
    """Return the rotations (B, 4) about y from x to where the y axis of the root points."""
    forward = rotate_vectors(rotations, np.array([0.0, 1.0, 0.0]))
    half = 0.5 * np.arctan2(-forward[:, 2], forward[:, 0])
    still = np.zeros_like(half)
    return np.column_stack([np.cos(half), still, np.sin(half), still])
