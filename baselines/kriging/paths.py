"""Paths of training recordings that match a new recording, one for each."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.recordings import visible_frames
from mocapbench.baselines.pose_viterbi import PoseViterbi
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["blend_paths", "doubt_about_path", "explained_share", "match_paths", "weigh_paths"]


_FAR = 4.0
"""Times the least error of a first path, beyond which a recording is not matched further: its
weight would be e⁻⁹ of the largest. Of a hundred strangers up to three quarters are left out."""
_SHARPNESS = 3.0
"""Of the weights of paths, between 2 and 4: 1 errs 2.8 % more and 8 .7 % (see `blend_paths`)."""
_DEPENDENCE = 30.0
"""As many residuals, in channels and frames, count as one: 10 to 100 err alike."""
_EXACT = 1e-12
"""Error of a path, as a fraction of the largest, below which it counts as exact."""


def match_paths(recording: Recording, matchers: Sequence[PoseViterbi]) -> tuple[Array, Array]:
    """Match a recording with frames of matchers, the subject's offset taken out before.

    Matchers that match far worse than the best one are left out.

    Returns
    -------
    paths : ndarray of shape (K, N, D)
        The matched training frames; K is at most the number of matchers.
    errors : ndarray of shape (K,)
        Variance of the residual at visible frames, summed over channels.
    """
    visible = visible_frames(recording)
    centre = recording.values[visible].mean(axis=0)
    offsets = [centre - matcher.frames_.mean(axis=0) for matcher in matchers]
    rough = np.array(list(map(partial(_match_roughly, recording), matchers, offsets)))
    errors = rough.var(axis=1).sum(axis=1)
    near = np.flatnonzero(errors <= _FAR * errors.min()).tolist()
    moved = [offsets[k] + rough[k].mean(axis=0) for k in near]
    paths = np.array(
        [_match_path(recording, matchers[k], to) for k, to in zip(near, moved, strict=True)]
    )
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
    weights = np.exp(_SHARPNESS * (1.0 - floored / floored.min()))
    return np.asarray(weights / weights.sum())


def blend_paths(weights: Array, products: Array) -> Array:
    r"""Return the weights of paths (K,), moved to those that explain visible frames best.

    A new subject is between those matched: its path is :math:`\sum_k (w_k + u_k) p_k - p \sum_k
    u_k`, with p the weighted mean of paths, and :math:`u_k` of variance :math:`w_k` before anything
    is seen, so that new subjects lie as far apart as paths do. This is ridge regression; weights
    sum to 1, and may be negative.

    Parameters
    ----------
    weights : ndarray of shape (K,)
        w; they sum to 1.
    products : ndarray of shape (K, K)
        Of the residuals of paths at visible frames, in units of their standard deviation.

    Returns
    -------
    ndarray of shape (K,)
        w, moved by the posterior mean of u.

    Notes
    -----
    On recordings from which ``in-betweening`` learns (gaps of a second, thirty strangers), blending
    takes 2 % from the errors of 24 people.
    """
    deviations = weights - np.eye(len(weights))  # of residuals: the mean's less each path's
    root = np.sqrt(weights)
    normal = np.outer(root, root) * (deviations @ products @ deviations.T)
    normal[np.diag_indices_from(normal)] += _DEPENDENCE
    moved = root * np.linalg.solve(normal, root * (deviations @ products @ weights))
    return np.asarray(weights * (1.0 - moved.sum()) + moved)


def doubt_about_path(predictions: Array, weights: Array) -> FrameByChannel:
    """Return the variance (N, D) of one more draw from those that ``predictions`` are draws of.

    0 for a single prediction, which says nothing about others.

    Parameters
    ----------
    predictions : ndarray of shape (K, N, D)
        What each path predicts.
    weights : ndarray of shape (K,)
    """
    # With q the sum of squared weights, the variance is the weighted mean square over 1 − q, and a
    # further draw from those whose mean is only estimated has 1 + q times that.
    squares = float((weights**2).sum())
    mean = np.tensordot(weights, predictions, axes=1)
    spread = np.tensordot(weights, (predictions - mean) ** 2, axes=1)
    return np.asarray(spread * (1.0 + squares) / max(1.0 - squares, np.finfo(float).eps))


def _match_path(
    recording: Recording, matcher: PoseViterbi, offset: NDArray[np.float64]
) -> FrameByChannel:
    """Return the path (N, D) that does not depend on a constant added to the recording.

    The subject's offset is the mean residual of a rough path, which an offset before it gave. A
    third such path changes errors by .1 %, the first by 2 %, each training walker of
    ``missing-frames`` left out.
    """
    offset = offset + _match_roughly(recording, matcher, offset).mean(axis=0)
    return matcher.match(recording.with_values(recording.values - offset))


def _match_roughly(
    recording: Recording, matcher: PoseViterbi, offset: NDArray[np.float64]
) -> FrameByChannel:
    """Return what a rough path leaves of visible frames (n, D), the offset taken out."""
    shifted = recording.with_values(recording.values - offset)
    unexplained = shifted.values - matcher.match_roughly(shifted)
    return np.asarray(unexplained[visible_frames(recording)])
