"""The images of a motion under the symmetries of the body: itself, and its mirror image.

Left and right take turns in a walk: half a cycle later, the body is in the mirror image of its
pose. What is seen of one side thus tells about the other. A golf swing has no such symmetry, which
its training recordings show.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray
from sklearn.metrics.pairwise import euclidean_distances

from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["Image", "symmetries"]

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


def symmetries(recordings: Sequence[Recording]) -> tuple[Image, ...]:
    """Return the images under which motions such as these look alike, the motion itself first.

    The mirror image is among them if channels have names such as ``lfemur.rx`` and ``rfemur.rx``,
    and if poses in it are near to poses of the same recording, the mean of each taken out.
    """
    channels = recordings[0].channels
    itself = (Image.itself(len(channels)),)
    mirrored = _mirror_image(channels)
    if mirrored is None:
        return itself
    shared = [_explained_share(mirrored, recording) for recording in recordings]
    return (*itself, mirrored) if np.mean(shared) >= _LEAST_SHARED else itself


def _mirror_image(channels: Sequence[str]) -> Image | None:
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
