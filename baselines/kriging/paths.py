"""Paths of training recordings that match a new recording, one for each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np

from mocapbench.baselines.common.recordings import visible_frames
from mocapbench.baselines.pose_viterbi import PoseViterbi
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["MatchedPaths"]


_ROUNDS = 2
"""How often a subject's offset is inferred from the path that the offset before it gave. A third
time changes errors by .1 %, the first by 2 %, each training walker of `missing-frames` left out."""
_EXACT = 1e-12
"""Error of a path, as a fraction of the largest, below which it counts as exact."""


@dataclass(frozen=True, eq=False)
class MatchedPaths:
    """The cheapest path of each of K training recordings, and how well it fits.

    Parameters
    ----------
    paths : ndarray of shape (K, N, D)
        The matched training frames.
    errors : ndarray of shape (K,)
        Variance of the residual at visible frames, summed over channels.
    moved : float
        Variance of the recording at visible frames, summed over channels.
    """

    paths: Array
    errors: Array
    moved: float

    @classmethod
    def of(cls, recording: Recording, matchers: Sequence[PoseViterbi]) -> Self:
        """Match a recording with each matcher's frames, the subject's offset taken out before."""
        visible = visible_frames(recording)
        paths = np.array([_path(recording, matcher) for matcher in matchers])
        errors = (recording.values - paths)[:, visible].var(axis=1).sum(axis=1)
        return cls(paths, errors, float(recording.values[visible].var(axis=0).sum()))

    @property
    def explained(self) -> float:
        """Which share of the recording's variance the best path explains, at most 1.

        It is negative where a pose that never changes would be nearer than any path.
        """
        least = float(self.errors.min())
        if least == 0.0:
            return 1.0
        return 1.0 - least / self.moved if self.moved > 0.0 else -np.inf

    @cached_property
    def weights(self) -> Array:
        """(K,) weights of the paths by their errors; they sum to 1."""
        # A floor keeps the ratio finite where a path is exact.
        errors = np.maximum(self.errors, _EXACT * self.errors.max()) + np.finfo(float).tiny
        weights = np.exp(-errors / errors.min())
        return np.asarray(weights / weights.sum())

    @cached_property
    def mean(self) -> FrameByChannel:
        """(N, D) the weighted mean of the paths."""
        return np.tensordot(self.weights, self.paths, axes=1)

    def doubt(self, predictions: Array) -> FrameByChannel:
        """Return the variance (N, D) of one more draw from those that ``predictions`` are draws of.

        0 for a single prediction, which says nothing about others.

        Parameters
        ----------
        predictions : ndarray of shape (K, N, D)
            What each path predicts.
        """
        # The variance over K paths is K / (K − 1) times their mean square, and a further draw from
        # those whose mean is only estimated has 1 + 1 / K times that.
        n_paths = len(predictions)
        mean = np.tensordot(self.weights, predictions, axes=1)
        spread = np.tensordot(self.weights, (predictions - mean) ** 2, axes=1)
        return np.asarray(spread * (n_paths + 1) / max(n_paths - 1, 1))


def _path(recording: Recording, matcher: PoseViterbi) -> FrameByChannel:
    """Return the path (N, D) that does not depend on a constant added to the recording.

    The subject's offset is first taken to be the difference of means, then the mean residual.
    """
    visible = visible_frames(recording)
    offset = recording.values[visible].mean(axis=0) - matcher.frames_.mean(axis=0)
    for _ in range(_ROUNDS):
        offset = offset + matcher.residual(recording.with_values(recording.values - offset))
    return matcher.match(recording.with_values(recording.values - offset))
