"""Whether clusters of recordings are the classes that people named."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from sklearn.metrics import adjusted_rand_score
from sklearn.metrics.cluster import contingency_matrix

from mocapbench.metrics.base import Clustering, Direction, Metric, Score

__all__ = ["adjusted_rand", "adjusted_rand_index", "average_purity", "purity"]


def average_purity(outcome: Clustering) -> Score:
    r"""Return Σ_c max_t n_ct / K, n_ct being how many recordings of class t are in cluster c.

    The mean of the clusters' purities, each the share of its majority class, weighted by their
    sizes. It never falls when a cluster is split, and is 1 for clusters of one: compare at equal
    numbers of clusters.

    References
    ----------
    HLM §4.1, footnote 4.
    """
    counts = _counts(outcome)
    return Score(float(counts.max(axis=0).sum() / counts.sum()))


def adjusted_rand_index(outcome: Clustering) -> Score:
    """Return the share of pairs on which clusters and classes agree, corrected for chance.

    1 for the classes themselves under any names, 0 on average for clusters of the same sizes drawn
    at random.

    References
    ----------
    Hubert and Arabie (1985), Comparing partitions.
    """
    _counts(outcome)
    return Score(float(adjusted_rand_score(outcome.truth, outcome.labels)))


def _counts(outcome: Clustering) -> NDArray[np.intp]:
    """Return how many recordings of each class (rows) are in each cluster (columns).

    Raises
    ------
    ValueError
        If there is no recording, or not one class and one cluster for each.
    """
    truth, labels = outcome.truth, outcome.labels
    if truth.ndim != 1 or not len(truth) or truth.shape != labels.shape:
        raise ValueError(
            "expected one class and one cluster for each of one or more recordings, "
            f"got shapes {truth.shape} and {labels.shape}"
        )
    return np.asarray(contingency_matrix(truth, labels))


purity = Metric("purity", "Purity", Direction.HIGHER, Clustering, average_purity)
adjusted_rand = Metric(
    "adjusted_rand", "Adjusted Rand index", Direction.HIGHER, Clustering, adjusted_rand_index
)
