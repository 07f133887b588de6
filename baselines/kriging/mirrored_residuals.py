r"""Gaussian processes of what a matched path leaves unexplained, and of its mirror image.

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
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from sklearn.metrics.pairwise import euclidean_distances

from mocapbench.baselines.kriging.conditioned import ConditionedFrames
from mocapbench.baselines.kriging.symmetry import Image
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel

__all__ = ["MirroredResiduals", "images_of"]


_CONSTANT, _DRIFT, _NOISE = 10.0, 1.0, 0.05
"""Prior variances of constants of the two sides, of the drift in time and of noise, up to scale."""


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
        shared = np.kron(alike, np.full((n_frames, n_frames), self.pose_variance))
        within = np.kron(np.eye(n_images), _DRIFT * drift)
        return np.asarray(shared * np.exp(-0.5 * distances) + within)

    @property
    def _middle(self) -> NDArray[np.bool_]:
        """(D,) which channels have no partner on the other side of the body."""
        return self.images[-1].kept
