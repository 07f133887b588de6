"""The problem of grouping recordings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.problems.arrays import Arrays, select_arrays
from mocapbench.benchmark.problems.base import InvalidPredictionError, Problem
from mocapbench.benchmark.problems.blending import blend_of
from mocapbench.benchmark.problems.cycle import alignment_of
from mocapbench.datasets import Skeleton
from mocapbench.metrics import Clustering

if TYPE_CHECKING:
    from mocapbench.baselines import Clusterer

__all__ = ["ClusterProblem", "Clusters"]


@dataclass(frozen=True, eq=False)
class Clusters:
    """The solution to a `ClusterProblem`.

    Parameters
    ----------
    labels : ndarray of int, shape (K,)
        The cluster of each recording.
    alignment : mapping of str to ndarray, or None
        Of a model that aligns: see ``alignment_of``.
    blend : mapping of str to ndarray, or None
        Of a model that blends styles and has found two or more: see ``blend_of``.
    """

    labels: NDArray[np.intp]
    alignment: Arrays | None = None
    blend: Arrays | None = None


@dataclass(frozen=True, eq=False)
class ClusterProblem(Problem[Clusters]):
    """Group the training recordings by a class that no model sees.

    Parameters
    ----------
    train : tuple of Recording
        What `fit` gets.
    truth : tuple of str
        The class of each training recording.
    skeleton : Skeleton
        The skeleton of the first recording, for figures.
    """

    truth: tuple[str, ...]
    skeleton: Skeleton

    def solve(self, model: Any, random_state: int) -> Clusters:
        """Return the clusters, and the alignment and the blend of a model that has them."""
        del random_state  # fit has done everything
        labels = self._labels(model)
        alignment = alignment_of(model, self.train) if "aligns" in model.provides else None
        n_channels = len(self.train[0].channels)
        blend = blend_of(model, labels, n_channels) if "blends" in model.provides else None
        return Clusters(labels, alignment, blend)

    def outcome(self, solution: Clusters) -> Clustering:
        """Set the clusters beside the classes."""
        return Clustering(np.array(self.truth), solution.labels)

    def to_arrays(self, solution: Clusters) -> Arrays:
        """Return ``labels``, and the arrays of the alignment and the blend."""
        return {
            "labels": solution.labels,
            **(solution.alignment or {}),
            **(solution.blend or {}),
        }

    def from_arrays(self, arrays: Arrays) -> Clusters:
        """Return the solution that `to_arrays` turned into ``arrays``."""
        alignment = select_arrays(arrays, "cycle_length", "path-")
        blend = select_arrays(arrays, "blend", "blended")
        return Clusters(arrays["labels"], alignment or None, blend or None)

    def _labels(self, model: Clusterer) -> NDArray[np.intp]:
        labels = np.asarray(model.labels_)
        if labels.shape != (len(self.truth),) or not np.issubdtype(labels.dtype, np.integer):
            raise InvalidPredictionError(
                f"labels_: expected {len(self.truth)} integers, one a recording, got an array of "
                f"shape {labels.shape} and type {labels.dtype}"
            )
        return labels.astype(np.intp)
