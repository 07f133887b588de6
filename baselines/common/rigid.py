"""Rigid motions of markers, and which markers move together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["FEWEST", "rotations", "steadiness"]

Array = NDArray[np.float64]

FEWEST = 3
"""Markers that a rotation needs."""
_ROUNDING = 1e-6
"""Relative changes of a distance below which it counts as constant."""
_TINY = 1e-300


def steadiness(recordings: Sequence[Array], marker: int) -> Array:
    """Return the inverse standard deviation of each marker's distance to ``marker``: (M,).

    It is relative to the largest one; 0 for the marker itself and for those never seen beside it.

    Parameters
    ----------
    recordings : sequence of ndarray of shape (N, M, 3)
        Markers, NaN where hidden. Distances vary about their mean in each recording.
    marker : int
    """
    counts, means, squares = (
        np.array(each) for each in zip(*_moments(recordings, marker), strict=True)
    )
    seen = counts.sum(axis=0)
    deviations = np.sqrt(squares.sum(axis=0) / np.maximum(seen, 1))
    steady = 1.0 / np.maximum(deviations, _ROUNDING * means.max(initial=_TINY))
    steady[seen < 2] = 0.0
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


def rotations(before: Array, after: Array, weights: Array) -> Array:
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
    :math:`U V^\top`, the last column of U turned if that would be a mirror image.

    References
    ----------
    W. Kabsch (1976), A Solution for the Best Rotation to Relate Two Sets of Vectors, *Acta
    Crystallographica* A32.
    """
    left, _, right = np.linalg.svd(np.einsum("k,ki,tkj->tij", weights, before, after))
    right[:, 2] *= np.linalg.det(left @ right)[:, None]
    return np.asarray(left @ right)
