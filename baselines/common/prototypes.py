"""K-means on recordings' prototypical cycles, after Pan and Torresani 2009, §4, and their tempi."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from sklearn.cluster import KMeans

from mocapbench.basics.arrays import Array

__all__ = ["cluster_cycles", "group_rows", "of_unit_variance", "tempi"]


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
    labels = group_rows((cycles / scale).reshape(len(cycles), -1), n_styles, n_restarts, rng)
    return labels, np.stack([cycles[labels == c].mean(axis=0) for c in np.unique(labels)])


def group_rows(
    features: Array, n_groups: int, n_restarts: int, rng: np.random.Generator
) -> NDArray[np.intp]:
    """Return the group (K,) of each row of features (K, F), by the best start of K-means.

    Starts are drawn among the rows in an order of their own, whatever order they come in.
    """
    order = sorted(range(len(features)), key=lambda row: tuple(features[row]))
    k_means = KMeans(
        min(n_groups, len(features)), n_init=n_restarts, random_state=int(rng.integers(2**31))
    )
    groups = np.empty(len(features), dtype=np.intp)
    groups[order] = k_means.fit_predict(features[order])
    return groups


def of_unit_variance(features: Array) -> Array:
    """Return features (K, F) about their means, of variance 1 along their first axis."""
    centred = features - features.mean(axis=0)
    # The largest singular value is √K times the standard deviation along the first axis.
    first = np.linalg.norm(centred, ord=2) / np.sqrt(len(features))
    rounding = np.finfo(float).eps * np.abs(features).max(initial=0.0) * np.sqrt(features.size)
    return np.asarray(centred / first if first > rounding else np.zeros_like(centred))


def tempi(paths: Sequence[NDArray[np.intp]], n_states: int) -> Array:
    """Return the tempo of each recording on a common cycle, about the mean of all.

    It is the logarithm of the states that a path advances by in a frame, at least one, with an
    error e(k) = s²/(N(k) − 1): s² is the variance of the advances about their means, relative to
    these and over all recordings. Of the variance of the logarithms, τ² is what the errors do not
    explain. Tempi are shrunk to τ/(τ² + e(k)) times the logarithm, so that they are 0 where they
    differ by no more than their errors, and of variance 1 where there are none.

    Parameters
    ----------
    paths : sequence of ndarray of int
        The states (N_k,) of each of K recordings.
    n_states : int
        States of the cycle.

    Returns
    -------
    ndarray of shape (K,)
        Their variance is at most 1. A recording of one frame has 0, the mean.
    """
    advances = [(np.diff(path) - 1) % n_states + 1 for path in paths]
    known = np.flatnonzero([len(advance) for advance in advances])
    tempo = np.zeros(len(paths))
    if not len(known):
        return tempo
    lengths = np.array([len(advances[k]) for k in known])
    means = np.array([advances[k].mean() for k in known])
    # e(k): the squared relative errors of all recordings, pooled, over the advances of each.
    relative = np.concatenate([advances[k] for k in known]) / np.repeat(means, lengths) - 1.0
    errors = np.square(relative).sum() / max(len(relative) - len(known), 1) / lengths
    # τ² is the variance of the logarithms less the mean error; logarithms are shrunk by it.
    logs = np.log(means) - np.log(means).mean()
    excess = max(logs.var() - errors.mean(), 0.0)
    tempo[known] = logs * np.sqrt(excess) / np.maximum(excess + errors, np.finfo(float).tiny)
    return np.asarray(tempo / max(1.0, tempo.std()))
