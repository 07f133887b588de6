r"""The mirror image of a motion, and processes of what a matched path leaves unexplained of both.

Left and right take turns in a walk: half a cycle later, the body is in the mirror image of its
pose. What is seen of one side thus tells about the other. A golf swing has no such symmetry, which
its training recordings show.

The residual of a channel at frame t, and at the mirror image of that frame, are values of one
process, with covariance :math:`\rho_{ii'} v\, e^{-\|m - m'\|^2 / 2 h^2 S} + \delta_{ii'} e^{-|t -
t'| / \tau}` between images i and i' of frames with matched poses m and m', up to the channel's
scale; ρ is 1 within an image and ``symmetry`` between images.

Besides, a channel has a constant, which is how this body, or where it faces, differs from training.
Nothing is known of it before: a constant that is added to a recording is added to its fill. A
channel in the middle of the body, such as the angle about the vertical, has a sign that the mirror
may change, so that its constant and that of its image have nothing to do with each other. Of a
channel that has a partner on the other side of the body, nothing is known of what both have in
common, while both differ little: half their difference has the variance :math:`10 (1 - \rho)`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray
from sklearn.metrics.pairwise import euclidean_distances

from mocapbench.baselines.kriging.conditioned import ConditionedFrames
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["Image", "MirroredResiduals", "find_symmetries", "images_of", "mirror_image"]

_SIDES = (("left", "right"), ("Left", "Right"), ("l", "r"), ("L", "R"))
"""How names of segments on the left and on the right begin."""
_SIGNS = {
    **dict.fromkeys(("tx", "dtx", "x", "ry", "rz"), -1.0),
    **dict.fromkeys(("ty", "dty", "y", "tz", "dtz", "z", "rx"), 1.0),
}
"""What becomes of a channel by its axis, if x points to a side of the body."""
_LEAST_SHARED = 0.5
"""The share of a motion's variance that its own poses explain in its mirror image; walks have 0.6
and more, golf swings and kicks 0.1 and less."""
_CONSTANT, _DRIFT, _NOISE = 10.0, 1.0, 0.05
"""Prior variances of constants of the two sides, of the drift in time and of noise, up to scale."""


@dataclass(frozen=True, eq=False)
class Image:
    """A map of frames: channels change places and signs.

    Parameters
    ----------
    order : ndarray of int, shape (D,)
        From which channel each one comes.
    signs : ndarray of shape (D,)
        1 or −1.
    """

    order: NDArray[np.intp]
    signs: NDArray[np.float64]

    @classmethod
    def itself(cls, n_channels: int) -> Self:
        """Return the map that changes nothing."""
        return cls(np.arange(n_channels), np.ones(n_channels))

    @property
    def kept(self) -> NDArray[np.bool_]:
        """(D,) which channels stay in place: those in the middle of the body."""
        return np.asarray(self.order == np.arange(len(self.order)))

    def of(self, frames: FrameByChannel) -> FrameByChannel:
        """Return the image of frames (N, D)."""
        return np.asarray(frames[:, self.order] * self.signs)

    def of_recording(self, recording: Recording) -> Recording:
        """Return the image of a recording."""
        return replace(recording, values=self.of(recording.values))


def find_symmetries(recordings: Sequence[Recording]) -> tuple[Image, ...]:
    """Return the images under which motions such as these look alike, the motion itself first.

    The mirror image is among them if channels have names such as ``lfemur.rx`` and ``rfemur.rx``,
    and if poses in it are near to poses of the same recording, the mean of each taken out.
    """
    channels = recordings[0].channels
    itself = (Image.itself(len(channels)),)
    mirrored = mirror_image(channels)
    if mirrored is None:
        return itself
    shared = [_explained_share(mirrored, recording) for recording in recordings]
    return (*itself, mirrored) if np.mean(shared) >= _LEAST_SHARED else itself


def images_of(frames: FrameByChannel, images: Sequence[Image]) -> FrameByChannel:
    """Return the images of frames (N, D), one below the other."""
    return np.concatenate([image.of(frames) for image in images])


@dataclass(frozen=True, eq=False)
class MirroredResiduals:
    """The processes of the residuals of all channels.

    Parameters
    ----------
    images : sequence of Image
        The motion itself, and its mirror image where training looks like it.
    pose_scale : float
        The square of the lengthscale over poses, h²S.
    pose_variance : float
        The prior variance v of the part that depends on pose.
    time_lengthscale : float
        The lengthscale τ over time, in frames.
    symmetry : float
        The correlation ρ of a residual with that of the mirror image in the same pose.
    """

    images: Sequence[Image]
    pose_scale: float
    pose_variance: float
    time_lengthscale: float
    symmetry: float

    def condition(
        self, matched: FrameByChannel, visible: NDArray[np.bool_]
    ) -> Iterator[tuple[NDArray[np.bool_], ConditionedFrames]]:
        """Yield groups of channels, as a mask (D,), and the process of each, given visible frames.

        Its frames are the images of all N frames, one image after the other.
        """
        prior, each = self.covariance(matched), np.tile(visible, len(self.images))
        constants = np.repeat(np.eye(len(self.images)), len(visible), axis=0)
        # Without symmetry the two sides have nothing in common, their constants neither.
        free = self._middle | (self.symmetry == 0.0)
        if free.any():
            yield free, ConditionedFrames(prior, _NOISE, each, constants)
        if not free.all():
            # (c, −c), of eigenvalue 10 (1 − ρ) in the covariance 10 (1, ρ; ρ, 1) of two constants.
            unlike = constants @ [[1.0], [-1.0]] / np.sqrt(2.0)
            apart = prior + _CONSTANT * (1.0 - self.symmetry) * unlike @ unlike.T
            yield ~free, ConditionedFrames(apart, _NOISE, each, np.ones((len(each), 1)))

    def covariance(self, matched: FrameByChannel) -> Array:
        """Return the covariance of the images of matched frames (N, D), without constants."""
        n_frames, n_images = len(matched), len(self.images)
        times = np.arange(n_frames)
        drift = np.exp(-np.abs(np.subtract.outer(times, times)) / self.time_lengthscale)
        # A body that faces another way would otherwise be far from its own mirror image.
        poses = images_of(matched - np.where(self._middle, matched.mean(axis=0), 0.0), self.images)
        distances = euclidean_distances(poses, squared=True) / self.pose_scale
        alike = np.where(np.eye(n_images, dtype=bool), 1.0, self.symmetry)
        # Between images the part that depends on pose alone, times ρ; within one drift, too.
        shared = np.kron(alike, np.full((n_frames, n_frames), self.pose_variance))
        within = np.kron(np.eye(n_images), _DRIFT * drift)
        return np.asarray(shared * np.exp(-0.5 * distances) + within)

    @property
    def _middle(self) -> NDArray[np.bool_]:
        """(D,) which channels have no partner on the other side of the body."""
        return self.images[-1].kept


def mirror_image(channels: Sequence[str]) -> Image | None:
    """Return the mirror image; None where names do not tell what it is."""
    parts = [name.rpartition(".") for name in channels]
    segments = {segment for segment, _, _ in parts}
    opposite = [f"{_opposite(segment, segments)}{dot}{axis}" for segment, dot, axis in parts]
    signs = np.array([_SIGNS.get(axis, 0.0) for _, _, axis in parts])
    known = signs.all() and opposite != list(channels) and set(opposite) == set(channels)
    if not known:
        return None
    return Image(np.array([list(channels).index(name) for name in opposite]), signs)


def _opposite(segment: str, segments: set[str]) -> str:
    """Return the segment on the other side of the body, or the same one in its middle."""
    for pair in _SIDES:
        for here, there in (pair, pair[::-1]):
            other = there + segment.removeprefix(here)
            if segment.startswith(here) and other in segments:
                return other
    return segment


def _explained_share(image: Image, recording: Recording) -> float:
    """Return the share of the image's variance that the recording's nearest poses explain."""
    frames = recording.values[recording.visible.all(axis=1)]
    frames = frames - frames.mean(axis=0)
    moved = image.of(frames)
    total = float((moved**2).sum())
    if total == 0.0:
        return 0.0
    return 1.0 - float(euclidean_distances(moved, frames, squared=True).min(axis=1).sum()) / total
