"""Paths of training recordings that match a new recording, one for each."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.baselines.common.recordings import visible_frames
from mocapbench.baselines.pose_viterbi import PoseViterbi
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["doubt_about_path", "explained_share", "match_paths", "weigh_paths"]


_ROUNDS = 2
"""How often a subject's offset is inferred from the path that the offset before it gave. A third
time changes errors by .1 %, the first by 2 %, each training walker of `missing-frames` left out."""
_EXACT = 1e-12
"""Error of a path, as a fraction of the largest, below which it counts as exact."""


def match_paths(recording: Recording, matchers: Sequence[PoseViterbi]) -> tuple[Array, Array]:
    """Match a recording with each matcher's frames, the subject's offset taken out before.

    Returns
    -------
    paths : ndarray of shape (K, N, D)
        The matched training frames.
    errors : ndarray of shape (K,)
        Variance of the residual at visible frames, summed over channels.
    """
    visible = visible_frames(recording)
    paths = np.array([_match_path(recording, matcher) for matcher in matchers])
    return paths, (recording.values - paths)[:, visible].var(axis=1).sum(axis=1)


def explained_share(errors: Array, total: float) -> float:
    """Return which share of the ``total`` variance of a recording the best path explains.

    It is at most 1, and negative where a pose that never changes would be nearer than any path.
    """
    least = float(errors.min())
    if least == 0.0:
        return 1.0
    return 1.0 - least / total if total > 0.0 else -np.inf


def weigh_paths(errors: Array) -> Array:
    """Return weights (K,) of paths by their errors (K,); they sum to 1."""
    # A floor keeps the ratio finite where a path is exact.
    floored = np.maximum(errors, _EXACT * errors.max()) + np.finfo(float).tiny
    weights = np.exp(-floored / floored.min())
    return np.asarray(weights / weights.sum())


def doubt_about_path(predictions: Array, weights: Array) -> FrameByChannel:
    """Return the variance (N, D) of one more draw from those that ``predictions`` are draws of.

    0 for a single prediction, which says nothing about others.

    Parameters
    ----------
    predictions : ndarray of shape (K, N, D)
        What each path predicts.
    weights : ndarray of shape (K,)
    """
    # The variance over K paths is K / (K − 1) times their mean square, and a further draw from
    # those whose mean is only estimated has 1 + 1 / K times that.
    n_paths = len(predictions)
    mean = np.tensordot(weights, predictions, axes=1)
    spread = np.tensordot(weights, (predictions - mean) ** 2, axes=1)
    return np.asarray(spread * (n_paths + 1) / max(n_paths - 1, 1))


def _match_path(recording: Recording, matcher: PoseViterbi) -> FrameByChannel:
    """Return the path (N, D) that does not depend on a constant added to the recording.

    The subject's offset is first taken to be the difference of means, then the mean residual.
    """
    visible = visible_frames(recording)
    offset = recording.values[visible].mean(axis=0) - matcher.frames_.mean(axis=0)
    for _ in range(_ROUNDS):
        offset = offset + matcher.residual(recording.with_values(recording.values - offset))
    return matcher.match(recording.with_values(recording.values - offset))
