"""Clusters of recordings, and their known classes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.metrics.outcomes.arrays import lock_fields

__all__ = ["Clustering"]


@dataclass(frozen=True, eq=False)
class Clustering:
    """Clusters of recordings, and their known classes.

    Lists are taken as arrays, which are read-only.

    Parameters
    ----------
    truth : ndarray of int or str, shape (K,)
        The class of each recording.
    labels : ndarray of int, shape (K,)
        Number of the cluster of each recording; the order of the numbers has no meaning.

    Raises
    ------
    ValueError
        If labels are not whole numbers, there is no recording, or not one class and one cluster for
        each.
    """

    truth: NDArray[Any]
    labels: NDArray[np.intp]

    def __post_init__(self) -> None:
        labels = np.asarray(self.labels)
        if labels.size and labels.dtype.kind not in "iu":
            raise ValueError(
                f"expected labels to be the whole number of a cluster for each recording, "
                f"got {self.labels!r}"
            )
        truth = np.asarray(self.truth)
        if truth.ndim != 1 or not len(truth) or truth.shape != labels.shape:
            raise ValueError(
                "expected one class and one cluster for each of one or more recordings, "
                f"got shapes {truth.shape} and {labels.shape}"
            )
        lock_fields(self, truth=truth, labels=labels)
