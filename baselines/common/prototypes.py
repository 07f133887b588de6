"""K-means on recordings' prototypical cycles, after Pan and Torresani 2009, §4, and their tempi."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from sklearn.cluster import KMeans

__all__ = ["cluster_cycles", "grouped", "of_unit_variance", "tempi"]

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
    labels = grouped((cycles / scale).reshape(len(cycles), -1), n_styles, n_restarts, rng)
    return labels, np.stack([cycles[labels == c].mean(axis=0) for c in np.unique(labels)])


def grouped(
    features: Array, n_groups: int, n_restarts: int, rng: np.random.Generator
) -> NDArray[np.intp]:
    """Return the group (K,) of each row of features (K, F), by the best start of K-means."""
    k_means = KMeans(
        min(n_groups, len(features)), n_init=n_restarts, random_state=int(rng.integers(2**31))
    )
    return np.asarray(k_means.fit_predict(features), dtype=np.intp)


def of_unit_variance(features: Array) -> Array:
    """Return features (K, F) about their means, of variance 1 along their first axis."""
    centred = features - features.mean(axis=0)
    first = np.linalg.norm(centred, ord=2) / np.sqrt(len(features))
    return np.asarray(centred / first if first > 0.0 else centred)


def tempi(paths: Sequence[NDArray[np.intp]], n_states: int) -> Array:
    """Return the tempo of each recording on a common cycle, about the mean of all.

    It is the logarithm of the states that a path advances by in a frame, at least one. The variance
    over recordings is the share of it that is not the error of means over frames: 1 where tempi are
    known well, 0 where they differ by no more than that error.

    Parameters
    ----------
    paths : sequence of ndarray of int
        The states (N_k,) of each of K recordings.
    n_states : int
        States of the cycle.

    Returns
    -------
    ndarray of shape (K,)
        0, the mean, for a recording of one frame.
    """
    advances = [(np.diff(path) - 1) % n_states + 1 for path in paths]
    known = [k for k, advance in enumerate(advances) if len(advance)]
    tempo = np.zeros(len(paths))
    if not known:
        return tempo
    means, spreads = np.array([(advances[k].mean(), advances[k].std()) for k in known]).T
    errors = (spreads / means) ** 2 / [len(advances[k]) for k in known]
    logs = np.log(means) - np.log(means).mean()
    variance = logs.var()
    if variance > errors.mean():
        tempo[known] = logs * np.sqrt(variance - errors.mean()) / variance
    return tempo
