"""Rigid motions of markers, and which markers move together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from mocapbench.basics.arrays import Array

__all__ = ["FEWEST", "find_rotations", "least_rotations", "spans_a_body", "steadiness"]


FEWEST = 3
"""Markers that a rotation needs."""
_ROUNDING = 1e-6
"""Relative changes of a distance below which it counts as constant."""
_CLEARLY = 5.0
"""How many times as far from a line as they scatter markers fix the rotation about it."""
_TINY = 1e-300


def steadiness(recordings: Sequence[Array], marker: int, least: float = _ROUNDING) -> Array:
    """Return the inverse standard deviation of each marker's distance to ``marker``: (M,).

    It is relative to the largest one; 0 for the marker itself and for those of which no recording
    shows two distances.

    Parameters
    ----------
    recordings : sequence of ndarray of shape (N, M, 3)
        Markers, NaN where hidden. Distances vary about their mean in each recording, which takes
        one degree of freedom.
    marker : int
    least : float, optional
        Standard deviations below this share of the largest mean distance count as this share.
    """
    counts, means, squares = (
        np.array(each) for each in zip(*_moments(recordings, marker), strict=True)
    )
    # The pooled standard deviation, each recording about its own mean.
    freedom = np.maximum(counts - 1, 0).sum(axis=0)
    deviations = np.sqrt(squares.sum(axis=0) / np.maximum(freedom, 1))
    steady = 1.0 / np.maximum(deviations, least * means.max(initial=_TINY))
    steady[freedom == 0] = 0.0
    return np.asarray(steady / steady.max(initial=_TINY))


def _moments(recordings: Sequence[Array], marker: int) -> Iterator[tuple[Array, Array, Array]]:
    """Yield numbers, means and summed squared deviations of distances (M,) by recording."""
    for places in recordings:
        distances = np.linalg.norm(places - places[:, [marker]], axis=2)
        distances[:, marker] = np.nan
        seen = ~np.isnan(distances)
        counts = seen.sum(axis=0)
        means = np.where(seen, distances, 0.0).sum(axis=0) / np.maximum(counts, 1)
        yield counts, means, (np.where(seen, distances - means, 0.0) ** 2).sum(axis=0)


def find_rotations(before: Array, after: Array, weights: Array) -> Array:
    r"""Return the rotations that take markers around their centre to others: (T, 3, 3).

    Parameters
    ----------
    before : ndarray of shape (K, 3)
        Weighted mean zero.
    after : ndarray of shape (T, K, 3)
        In each of T frames, weighted mean zero.
    weights : ndarray of shape (K,)

    Notes
    -----
    With the singular values :math:`\sum_k w_k b_k^\top a_k = U S V^\top` of row vectors, they are
    :math:`U V^\top`, the last column of U negated if that would be a mirror image.

    References
    ----------
    W. Kabsch (1976), A Solution for the Best Rotation to Relate Two Sets of Vectors, *Acta
    Crystallographica* A32.
    """
    left, _, right = np.linalg.svd(np.einsum("k,ki,tkj->tij", weights, before, after))
    # The determinant is −1 where U Vᵀ would be a mirror image.
    right[:, 2] *= np.linalg.det(left @ right)[:, None]
    return np.asarray(left @ right)


def least_rotations(before: Array, after: Array, weights: Array) -> Array:
    """Return the least rotations that take the line along which markers lie to others: (T, 3, 3).

    Nothing rotates about the line itself. Parameters are those of `find_rotations`.
    """
    line = _principal(before, weights)[1][0]
    ahead = np.einsum("k,tki->ti", weights * (before @ line), after)
    ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), _TINY)
    cosine = ahead @ line
    # Rodrigues: I + [v] + [v]² / (1 + cos θ) with v = line × ahead, whose length is sin θ.
    cross = _cross(np.cross(line, ahead))
    twice = cross @ cross / np.maximum(1.0 + cosine, _TINY)[:, None, None]
    return np.asarray(np.eye(3) + cross + twice)


def spans_a_body(shapes: Array, weights: Array) -> bool:
    """Return whether markers fix every rotation of a body that moves with them.

    Markers on a line leave the rotation about it open. Those beside the line fix it if they lie
    clearly farther from it than they scatter from frame to frame; a slow change of shape does no
    harm.

    Parameters
    ----------
    shapes : ndarray of shape (T, K, 3)
        The markers in successive frames, as seen from the body; weighted mean zero.
    weights : ndarray of shape (K,)
    """
    shape = shapes.mean(axis=0)
    lengths, axes = _principal(shape, weights)
    distance = weights @ (_beside(shape, axes[0]) ** 2).sum(axis=1)
    # Half the mean squared step is the variance of what scatters from frame to frame.
    steps = _beside(np.diff(shapes, axis=0), axes[0])
    scatter = 0.5 * float((weights @ (steps**2).sum(axis=2).T).sum()) / max(len(steps), 1)
    return bool(lengths[1] > _ROUNDING * lengths[0] and distance > _CLEARLY**2 * scatter)


def _principal(shape: Array, weights: Array) -> tuple[Array, Array]:
    """Return how far markers (K, 3) around their centre reach along three axes, and these."""
    _, lengths, axes = np.linalg.svd(np.sqrt(weights)[:, None] * shape, full_matrices=False)
    return lengths, axes


def _beside(points: Array, line: Array) -> Array:
    """Return points (..., 3) less their parts along a line."""
    return np.asarray(points - (points @ line)[..., None] * line)


def _cross(axes: Array) -> Array:
    """Return the matrices (..., 3, 3) by which row vectors become their products with axes."""
    return np.asarray(np.cross(axes[..., None, :], np.eye(3)))
