r"""Where a motion faces, taken out of the rotation and the path of its root.

A walk to the north and the same walk to the east are one motion. The root of the Acclaim format
turns by :math:`R = R_z R_y R_x`, in the channels ``root.rx``, ``root.ry`` and ``root.rz``; the y
axis points up. Each of these angles changes if the body is turned about the vertical, and not by a
constant. Here the rotation is :math:`R = R_y(\psi + h) R_x(p) R_z(r)` instead, with the mean
heading ψ of the recording: to turn the body changes ψ alone. The heading h from ψ takes the place
of ``root.ry``, the pitch p that of ``root.rx`` and the roll r that of ``root.rz``. The root's path
is turned back by ψ, so that ``root.tz`` or ``root.dtz`` lead ahead and ``root.tx`` or ``root.dtx``
aside.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial.transform import Rotation

from mocapbench.baselines.common.recordings import interpolate_channels
from mocapbench.baselines.protocols import Prediction
from mocapbench.basics.arrays import Array, Index
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["face_ahead", "face_as_before"]


_ANGLES = ("root.ry", "root.rx", "root.rz")
"""Heading, pitch and roll, in this order."""
_PATHS = (("root.tx", "root.tz"), ("root.dtx", "root.dtz"))
"""Aside and ahead: positions, or differences of them."""
_STEP = 1e-4
"""Radians by which angles are changed to see what follows from them."""


def face_ahead(recording: Recording) -> tuple[Recording, float]:
    """Return a recording turned so that its mean heading is ahead, and that heading in radians.

    A recording without the rotation of a root, in degrees, is returned as it is. Where a part of
    the rotation or of the path is hidden, all of it is.
    """
    angles = _find_angles(recording)
    if not len(angles):
        return recording, 0.0
    values = recording.values.copy()
    seen = np.flatnonzero(recording.visible[:, angles].all(axis=1))
    turned = _to_headings(values[np.ix_(seen, angles)])
    heading = float(np.angle(np.exp(1j * turned[:, 0]).sum())) if len(seen) else 0.0
    turned[:, 0] -= heading
    # Angles unwrapped from ±180° may be multiples of 360° away.
    turned -= 2.0 * np.pi * np.round(turned.sum(axis=0) / max(len(seen), 1) / (2.0 * np.pi))
    values[:, angles] = np.nan
    values[np.ix_(seen, angles)] = np.degrees(turned)
    for path in _find_paths(recording):
        values[:, path] = _rotate_path(values[:, path], -heading)
    return recording.with_values(values), heading


def face_as_before(
    recording: Recording, mean: FrameByChannel, variance: FrameByChannel | None, heading: float
) -> Prediction:
    """Return the prediction of a recording from that of what `face_ahead` made of it.

    Of the two ways to write a rotation as three angles, and of those that differ by multiples of
    360°, the one is taken that is nearest to the angles that are visible before and after.
    """
    angles = _find_angles(recording)
    if not len(angles):
        return Prediction.around(recording, mean, variance)
    hidden = np.flatnonzero(~recording.visible[:, angles].all(axis=1))
    place, mean = np.ix_(hidden, angles), mean.copy()
    ahead = np.radians(mean[place]) + np.array([heading, 0.0, 0.0])
    near = interpolate_channels(recording.values[:, angles], recording.times)[hidden]
    mean[place] = np.degrees(_choose_angles(_to_angles(ahead), np.radians(near)))
    slopes = _slopes(ahead)
    paths, variance = _find_paths(recording), None if variance is None else variance.copy()
    for path in paths:
        mean[:, path] = _rotate_path(mean[:, path], heading)
    if variance is not None:
        variance[place] = np.einsum("nij,nj->ni", slopes**2, variance[place])
        for path in paths:
            variance[:, path] = variance[:, path] @ (_rotation(heading) ** 2).T
    return Prediction.around(recording, mean, variance)


def _find_angles(recording: Recording) -> Index:
    """Return the places (3,) of heading, pitch and roll among the channels; (0,) if they lack."""
    found = _find(recording, _ANGLES)
    alike = [recording.units[place] == "deg" for place in found]
    return found if all(alike) else found[:0]


def _find_paths(recording: Recording) -> list[Index]:
    """Return the places (2,) of each way aside and ahead among the channels."""
    found = (_find(recording, names) for names in _PATHS)
    return [places for places in found if len(places)]


def _find(recording: Recording, names: Sequence[str]) -> Index:
    if not {*names} <= {*recording.channels}:
        return np.zeros(0, dtype=np.intp)
    return np.array([recording.channels.index(name) for name in names], dtype=np.intp)


def _rotation(angle: float) -> Array:
    """Return the matrix (2, 2) that turns (aside, ahead) about the vertical."""
    return np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])


def _rotate_path(path: FrameByChannel, angle: float) -> FrameByChannel:
    return np.asarray(path @ _rotation(angle).T)


def _to_headings(angles: FrameByChannel) -> FrameByChannel:
    """Return heading, pitch and roll in radians, unwrapped, from ry, rx and rz in degrees."""
    if not len(angles):
        return angles
    rotation = Rotation.from_euler("xyz", angles[:, [1, 0, 2]], degrees=True)
    return np.unwrap(rotation.as_euler("YXZ"), axis=0)


def _to_angles(headings: Array) -> Array:
    """Return ry, rx and rz in radians from heading, pitch and roll."""
    if not len(headings):
        return headings
    return np.asarray(Rotation.from_euler("YXZ", headings).as_euler("xyz")[:, [1, 0, 2]])


def _choose_angles(angles: Array, near: Array) -> Array:
    """Return the same rotations by the angles that are nearest to others (n, 3)."""
    mirrored = angles * [-1.0, 1.0, 1.0] + np.pi
    ways = np.array([angles, mirrored])
    ways -= 2.0 * np.pi * np.round((ways - np.nan_to_num(near)) / (2.0 * np.pi))
    far = (np.abs(ways - np.nan_to_num(near)) ** 2).sum(axis=2)
    return np.asarray(np.where((far[0] <= far[1])[:, None], ways[0], ways[1]))


def _slopes(headings: Array) -> Array:
    """Return by how much each of ry, rx and rz changes with heading, pitch and roll: (n, 3, 3)."""
    slopes = np.empty((len(headings), 3, 3))
    for column in range(3):
        step = _STEP * np.eye(3)[column]
        change = _to_angles(headings + step) - _to_angles(headings - step)
        slopes[:, :, column] = (change + np.pi) % (2.0 * np.pi) - np.pi
    return slopes / (2.0 * _STEP)
