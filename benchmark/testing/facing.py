"""Checks of models that fill a motion alike wherever it stands and faces."""

from __future__ import annotations

import re
from functools import cache
from typing import Any, cast

import numpy as np
from scipy.spatial.transform import Rotation

from mocapbench.baselines.kriging.mirror_images import Image, mirror_image
from mocapbench.basics.arrays import Array
from mocapbench.benchmark.testing.errors import require
from mocapbench.benchmark.testing.subject import Subject
from mocapbench.datasets import Mask, Recording, joint_positions, joint_trajectories, open_archive

__all__ = [
    "fills_alike_however_it_faces",
    "fills_markers_alike_if_mirrored",
    "fills_markers_alike_wherever_they_stand",
    "load_marked_walks",
    "rotate_motion",
]

_WALKS = ("gait:01_01", "gait:02_01", "gait:03_01")
"""Generated walkers, of whom the last one is filled."""
_DEGREES = (90.0, 180.0, -37.0)
_AWAY = np.array([40.0, 0.0, -70.0])
"""How far a motion is moved over the ground, in the unit of the root's path."""
_HIDDEN = ("rradius.", "rwrist.", "rhand.", "rfingers.", "rthumb.")
"""Joints that a gap of markers hides: a forearm and its hand."""
_MOST = 0.01
"""What turns may change, as a share of the error."""


def fills_alike_however_it_faces(subject: Subject) -> None:
    """Check that a motion that is turned about the vertical, and moved, is filled alike."""
    *training, walk = _walks()
    model, gap = subject.fit_model(training), np.zeros(walk.values.shape, dtype=bool)
    gap[15:30] = True
    joints = _place_joints(walk)
    filled = _place_joints(_fill(model, walk, gap))
    error = float(np.sqrt(np.mean((filled - joints)[15:30] ** 2)))
    for degrees in _DEGREES:
        about = Rotation.from_euler("y", degrees, degrees=True)
        moved = rotate_motion(walk, degrees, _AWAY)
        turned = _place_joints(_fill(model, moved, gap))
        # The joints of the turned motion less their own truth, turned back.
        change = about.inv().apply((turned - _place_joints(moved)).reshape(-1, 3))
        gap_to = float(np.sqrt(np.mean((change - (filled - joints).reshape(-1, 3)) ** 2)))
        require(
            gap_to <= _MOST * error,
            f"the same fill of a walk that is turned by {degrees:g}° and moved",
            f"joints that differ by {gap_to / error:.2g} of their error",
            "take out where each recording faces, or leave out 'turns along'",
        )


def fills_markers_alike_wherever_they_stand(subject: Subject) -> None:
    """Check that markers that are turned about the vertical, and moved, are filled alike."""
    model, walk, gap, filled, error = _fill_markers(subject)
    for degrees in _DEGREES:
        moved = _move_markers(walk, degrees)
        expected = _move_markers(walk.with_values(filled), degrees).values
        change = (_fill(model, moved, gap).values - expected)[gap]
        share = float(np.sqrt(np.mean(change**2))) / error
        require(
            share <= _MOST,
            f"the same fill of markers that are turned by {degrees:g}° and moved",
            f"markers that differ by {share:.2g} of their error",
            "take out where each recording stands and faces, or leave out 'moves along'",
        )


def fills_markers_alike_if_mirrored(subject: Subject) -> None:
    """Check that markers are filled alike if left and right change places, training as it is."""
    model, walk, gap, filled, error = _fill_markers(subject)
    image = cast("Image", mirror_image(walk.channels))  # names of joints tell their sides
    mirrored = _fill(model, image.of_recording(walk), gap[:, image.order])
    share = float(np.sqrt(np.mean((image.of(mirrored.values) - filled)[gap] ** 2))) / error
    require(
        share <= _MOST,
        "the same fill of markers whose left and right have changed places",
        f"markers that differ by {share:.2g} of their error",
        "learn from mirror images, too, or leave out 'mirrors along'",
    )


def _fill_markers(subject: Subject) -> tuple[Any, Recording, Mask, Array, float]:
    """Return a fitted model, a walk, its gap (N, D), the walk filled (N, D), and the error."""
    *training, walk = load_marked_walks()
    model, gap = subject.fit_model(training), np.zeros(walk.values.shape, dtype=bool)
    gap[15:30, _list_hidden(model, walk)] = True
    filled = _fill(model, walk, gap).values
    return model, walk, gap, filled, float(np.sqrt(np.mean((filled - walk.values)[gap] ** 2)))


def _move_markers(walk: Recording, degrees: float) -> Recording:
    about = Rotation.from_euler("y", degrees, degrees=True)
    moved = about.apply(walk.values.reshape(-1, 3).copy()) + _AWAY
    return walk.with_values(moved.reshape(walk.values.shape))


def _list_hidden(model: object, walk: Recording) -> list[int]:
    """Return the channels of a gap: all of them for models of whole frames."""
    joints = _HIDDEN if "fills entries" in model.provides else ""  # type: ignore[attr-defined]
    return [d for d, name in enumerate(walk.channels) if name.startswith(joints)]


def rotate_motion(recording: Recording, degrees: float, away: Array | float = 0.0) -> Recording:
    """Return a complete motion of the Acclaim format turned about the y axis, its path shifted."""
    values, names = recording.values.copy(), recording.channels
    about = Rotation.from_euler("y", degrees, degrees=True)
    angles = [names.index(f"root.r{axis}") for axis in "xyz"]
    path = [d for d, name in enumerate(names) if re.fullmatch(r"root\.d?t[xyz]", name)]
    rotation = about * Rotation.from_euler("xyz", values[:, angles], degrees=True)
    values[:, angles] = np.unwrap(rotation.as_euler("xyz", degrees=True), axis=0, period=360.0)
    values[:, path] = about.apply(values[:, path]) + away
    return recording.with_values(values)


@cache
def _walks() -> tuple[Recording, ...]:
    archive, frames = open_archive(), np.arange(0, 200, 4)
    return tuple(archive.recording(uri).frames(frames) for uri in _WALKS)


@cache
def load_marked_walks() -> tuple[Recording, ...]:
    """Return 50 frames of each of three generated walks, as joints in space."""
    archive = open_archive()
    walks = zip(_WALKS, _walks(), strict=True)
    return tuple(joint_trajectories(archive.skeleton(uri), walk) for uri, walk in walks)


def _fill(model: object, walk: Recording, gap: Mask) -> Recording:
    (prediction,) = model.impute([walk.hide(gap)])  # type: ignore[attr-defined]
    return walk.with_values(prediction.mean)


def _place_joints(recording: Recording) -> Array:
    return np.asarray(joint_positions(open_archive().skeleton(_WALKS[-1]), recording))
