"""K-means on recordings' prototypical cycles, after Pan and Torresani 2009, §4."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from sklearn.cluster import KMeans

__all__ = ["cluster_cycles"]

Array = NDArray[np.float64]


def cluster_cycles(
    cycles: Array, scale: Array, n_styles: int, n_restarts: int, rng: np.random.Generator
) -> tuple[NDArray[np.intp], Array]:
    """Group recordings by their cycles.

    Parameters
    ----------
    cycles : ndarray of shape (K, M, D)
        The prototypical cycle of each recording, aligned with the others.
    scale : ndarray of shape (D,)
        The unit of each channel.
    n_styles : int
        Number of clusters; the number of recordings, if that is smaller.
    n_restarts : int
        Number of starts of K-means.
    rng : numpy.random.Generator
        Where its seed is drawn from.

    Returns
    -------
    labels : ndarray of int, shape (K,)
    means : ndarray of shape (C, M, D)
        The mean cycle of each cluster.
    """
    k_means = KMeans(
        min(n_styles, len(cycles)), n_init=n_restarts, random_state=int(rng.integers(2**31))
    )
    labels = k_means.fit_predict((cycles / scale).reshape(len(cycles), -1)).astype(np.intp)
    return labels, np.stack([cycles[labels == c].mean(axis=0) for c in np.unique(labels)])
