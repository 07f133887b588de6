"""Agreement of clusters of recordings with their known classes."""

from __future__ import annotations

from mocapbench.metrics.base import Direction, Score, metric
from mocapbench.metrics.outcomes.clustering import Clustering

__all__ = ["adjusted_rand", "purity"]


@metric(
    title="Purity",
    direction=Direction.HIGHER,
    sentence=(
        "Share of recordings that belong to the majority style of their cluster; it grows with "
        "the number of clusters by itself."
    ),
    range="0 to 1",
    source="Pan and Torresani 2009",
)
def purity(outcome: Clustering) -> Score:
    r"""Return Σ_c max_t n_ct / K, with n_ct recordings of class t in cluster c.

    It is the mean of the clusters' purities, each the share of its most frequent class, weighted by
    their sizes. It never falls when a cluster is split and is 1 for clusters of one recording:
    compare at equal numbers of clusters.

    Parameters
    ----------
    outcome : Clustering
        Of K recordings.

    Returns
    -------
    Score
        Without parts.

    Warnings
    --------
    More clusters are never worse, and clusters of one recording are pure: compare only at equal
    numbers of clusters. Where one class is frequent, one cluster of everything scores its share.

    Notes
    -----
    With :math:`n_{ct}` recordings of class t in cluster c, of K recordings in all:

    .. math:: \frac{1}{K} \sum_c \max_t n_{ct}

    References
    ----------
    Pan and Torresani (2009), Unsupervised hierarchical modeling of locomotion styles (HLM), §4.1,
    footnote 4.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Clustering, purity
    >>> styles = np.array(["walk", "walk", "walk", "run"])
    >>> purity(Clustering(truth=styles, labels=np.array([0, 0, 1, 1]))).value
    0.75
    >>> purity(Clustering(truth=styles, labels=np.array([1, 1, 1, 0]))).value
    1.0
    """
    # Imported where it is used, as it takes longer than all there is to say of the metrics.
    from sklearn.metrics.cluster import contingency_matrix  # noqa: PLC0415

    counts = contingency_matrix(outcome.truth, outcome.labels)  # classes are rows
    return Score(float(counts.max(axis=0).sum() / counts.sum()))


@metric(
    title="Adjusted Rand index",
    direction=Direction.HIGHER,
    sentence=(
        "Share of pairs of recordings rightly put together or apart, corrected for chance: 0 by "
        "chance, 1 for the styles."
    ),
    range="−0.5 to 1",
    source="Hubert and Arabie 1985",
)
def adjusted_rand(outcome: Clustering) -> Score:
    r"""Return how far clusters and classes agree on pairs of recordings, corrected for chance.

    It is (RI − E[RI]) / (1 − E[RI]), where RI is the share of pairs of recordings that are
    together, or apart, in both. 1 if clusters are the classes, under any names; 0 on average for
    random clusters of the same sizes.

    Parameters
    ----------
    outcome : Clustering
        Of K recordings.

    Returns
    -------
    Score
        Without parts.

    Warnings
    --------
    With more clusters than classes even a perfect split of classes scores below 1. It can be
    negative, and of few recordings one that moves changes it much.

    Notes
    -----
    With RI the share of pairs of recordings on which clusters and classes agree, and E its mean
    over random clusters of the same sizes:

    .. math:: \mathrm{ARI} = \frac{\mathrm{RI} - E[\mathrm{RI}]}{1 - E[\mathrm{RI}]}

    References
    ----------
    Hubert and Arabie (1985), Comparing partitions.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Clustering, adjusted_rand
    >>> styles = np.array(["walk", "walk", "walk", "run"])
    >>> adjusted_rand(Clustering(truth=styles, labels=np.array([0, 0, 1, 1]))).value
    0.0
    >>> adjusted_rand(Clustering(truth=styles, labels=np.array([1, 1, 1, 0]))).value
    1.0
    """
    from sklearn.metrics import adjusted_rand_score  # noqa: PLC0415

    return Score(float(adjusted_rand_score(outcome.truth, outcome.labels)))
