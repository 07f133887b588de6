r"""Where markers stand and face, taken out of recordings, so that a walk is one wherever it goes.

The markers that a recording never hides say where the body is: their mean :math:`c_t` in frame t.
Their shape about it, in the mean over frames, says which way the recording faces: the rotation R
that takes it best to that of a reference recording. A marker at x is :math:`R^\top (x - c_t)` as
seen from there. One rotation serves for a whole recording, whatever its vertical axis is: who turns
around in it is seen to turn.

Where whole frames are hidden, nothing says where the body is in them. The mean of all markers over
visible frames is c then, in every frame, and the reference is turned so that the line from one side
of the body to the other is the x axis, which `mocapbench.baselines.kriging.mirror_images` reflects.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.baselines.common.markers import marker_places
from mocapbench.baselines.common.recordings import interpolate_channels
from mocapbench.baselines.common.rigid import FEWEST, find_rotations, least_rotations
from mocapbench.baselines.kriging.mirror_images import mirror_image
from mocapbench.baselines.protocols import Prediction
from mocapbench.basics.arrays import Array, Index
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["Stance", "find_reference", "find_stance", "find_stances"]

_FLAT = 1e-6
"""Markers beside which no other lies farther, as a share, are on a line."""
_ASIDE = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
"""The two sides of a body that faces as a reference does."""


class Stance:
    """Where the markers of a recording stand and face.

    Parameters
    ----------
    places : ndarray of shape (M, 3)
        The channels of each marker.
    path : ndarray of shape (N, 3)
        The mean of its guides.
    rotation : ndarray of shape (3, 3)
        Row vectors from the reference's direction times it are in that of the recording.
    """

    def __init__(self, places: Index, path: Array, rotation: Array) -> None:
        self.places: Index = places
        self.path: Array = path
        self.rotation: Array = rotation

    def take_out(self, recording: Recording) -> Recording:
        """Return the recording as seen from its body."""
        if not self.places.size:
            return recording
        values = recording.values.copy()
        seen = values[:, self.places] - self.path[:, np.newaxis]
        values[:, self.places] = seen @ self.rotation.T
        return recording.with_values(values)

    def put_back(
        self, recording: Recording, mean: FrameByChannel, variance: FrameByChannel | None
    ) -> Prediction:
        """Return the prediction of a recording from that of what `take_out` made of it."""
        mean, variance = mean.copy(), None if variance is None else variance.copy()
        mean[:, self.places] = mean[:, self.places] @ self.rotation + self.path[:, np.newaxis]
        if variance is not None:
            # Of each coordinate alone: those of a marker vary independently before.
            variance[:, self.places] = variance[:, self.places] @ self.rotation**2
        return Prediction.around(recording, mean, variance)


def find_stances(recordings: Sequence[Recording], own: int) -> list[Stance]:
    """Return where the markers of each recording stand and face.

    They face as the first of the others does on the whole.

    Parameters
    ----------
    recordings : sequence of Recording
    own : int
        The place of the recording whose visible markers are the guides. Where fewer than three are
        visible throughout it, and somewhere in all others, there is nothing to take out.
    """
    markers = marker_places(recordings[0].channels, recordings[0].units)
    guides = _find_guides(recordings, recordings[own], markers)
    if len(guides) < FEWEST:
        return [_take_nothing(recording) for recording in recordings]
    shapes = [_follow_guides(recording, guides) for recording in recordings]
    reference = next((shape for k, (_, shape) in enumerate(shapes) if k != own), shapes[own][1])
    return [Stance(markers, path, _rotate(reference, shape)) for path, shape in shapes]


def find_reference(recording: Recording) -> Array:
    """Return the mean shape (M, 3) of the markers of a recording, about their centre.

    If names of markers tell the sides of the body, it is turned so that these are on the x axis,
    and averaged with its mirror image, to which the mirror image of a body then turns as the body
    itself does.
    """
    markers = marker_places(recording.channels, recording.units)
    shape = _average_markers(recording, markers)
    shape = shape - shape.mean(axis=0) if len(shape) else shape
    image = mirror_image(recording.channels)
    if image is None or not len(shape):
        return shape
    opposite = [markers[:, 0].tolist().index(place) for place in image.order[markers[:, 0]]]
    side = (shape - shape[opposite])[np.arange(len(shape)) < opposite].sum(axis=0)
    turn = least_rotations(np.array([side, -side]), _ASIDE[np.newaxis], np.ones(2))[0]
    upright = shape @ turn
    return np.asarray((upright + upright[opposite] * [-1.0, 1.0, 1.0]) / 2.0)


def find_stance(recording: Recording, reference: Array) -> Stance:
    """Return where the markers of a recording of whole frames stand and face, frames alike.

    Parameters
    ----------
    recording : Recording
    reference : ndarray of shape (M, 3)
        What `find_reference` returned of another one with the same channels. Fewer markers than
        three, or a recording without complete frames, have nothing to take out.
    """
    markers = marker_places(recording.channels, recording.units)
    shape = _average_markers(recording, markers)
    if len(shape) < FEWEST or len(reference) < FEWEST:
        return _take_nothing(recording)
    centre = shape.mean(axis=0)
    path = np.tile(centre, (len(recording.times), 1))
    return Stance(markers, path, _rotate(reference, shape - centre))


def _take_nothing(recording: Recording) -> Stance:
    """Return the stance that leaves a recording as it is."""
    return Stance(np.zeros((0, 3), np.intp), np.zeros((len(recording.times), 3)), np.eye(3))


def _average_markers(recording: Recording, markers: Index) -> Array:
    """Return the mean position of markers in complete frames (M, 3); (0, 3) without any."""
    complete = recording.visible.all(axis=1)
    kept = markers if complete.any() else markers[:0]
    return np.asarray(recording.values[complete][:, kept].sum(axis=0) / max(complete.sum(), 1))


def _find_guides(recordings: Sequence[Recording], own: Recording, markers: Index) -> Index:
    """Return the channels (K, 3) of the markers that say where a body is."""
    always = own.visible[:, markers].all(axis=(0, 2))
    known = [recording.visible[:, markers].all(axis=2).any(axis=0) for recording in recordings]
    return np.asarray(markers[always & np.all(known, axis=0)])


def _follow_guides(recording: Recording, guides: Index) -> tuple[Array, Array]:
    """Return the mean of guides in each frame (N, 3), and their mean shape about it (K, 3)."""
    flat = interpolate_channels(recording.values[:, guides.ravel()], recording.times)
    positions = flat.reshape(-1, *guides.shape)
    path = positions.mean(axis=1)
    return path, (positions - path[:, np.newaxis]).mean(axis=0)


def _rotate(reference: Array, shape: Array) -> Array:
    """Return the rotation from one shape to another; none for markers on a line."""
    lengths = np.linalg.svd(reference, compute_uv=False), np.linalg.svd(shape, compute_uv=False)
    if any(second <= _FLAT * first for first, second, _ in lengths):
        return np.eye(3)
    return np.asarray(find_rotations(reference, shape[np.newaxis], np.ones(len(shape)))[0])
