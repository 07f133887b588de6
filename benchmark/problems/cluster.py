"""The problem of grouping recordings."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines import Aligner, Blender, Clusterer, StatePath
from mocapbench.benchmark.problems.base import InvalidPredictionError, Problem, Solution
from mocapbench.benchmark.problems.blending import passage
from mocapbench.datasets import Skeleton
from mocapbench.metrics import Clustering

__all__ = ["ClusterProblem"]


@dataclass(frozen=True, eq=False)
class ClusterProblem(Problem):
    """Group the training recordings by a class that no model sees.

    Parameters
    ----------
    truth : tuple of str
        The class of each training recording.
    skeleton : Skeleton
        On which the first recording's angles are to be seen.
    """

    truth: tuple[str, ...]
    skeleton: Skeleton

    def solve(self, model: Clusterer, random_state: int) -> Solution:
        """Return ``labels`` (K,), and what else the model can tell of its clusters.

        Of a model that aligns, ``cycle_length`` and ``path-k`` (N_k,); of one that blends, the
        `mocapbench.benchmark.problems.blending.passage`.
        """
        del random_state  # all is said in fit
        labels = self._labels(model)
        return {"labels": labels, **dict(self._alignment(model)), **self._blend(model, labels)}

    def outcome(self, solution: Solution) -> Clustering:
        """Set the clusters beside the classes."""
        return Clustering(np.array(self.truth), solution["labels"])

    def _labels(self, model: Clusterer) -> NDArray[np.intp]:
        labels = np.asarray(model.labels_)
        if labels.shape != (len(self.truth),) or not np.issubdtype(labels.dtype, np.integer):
            raise InvalidPredictionError(
                f"labels_: expected {len(self.truth)} integers, one a recording, got an array of "
                f"shape {labels.shape} and type {labels.dtype}"
            )
        return labels.astype(np.intp)

    def _alignment(self, model: Clusterer) -> Iterator[tuple[str, NDArray[np.intp]]]:
        if isinstance(model, Aligner):
            yield "cycle_length", np.array(model.cycle_length_)
            for index, path in enumerate(self._paths(model)):
                yield f"path-{index}", path

    def _blend(self, model: Clusterer, labels: NDArray[np.intp]) -> Solution:
        if not isinstance(model, Blender):
            return {}
        return passage(model, labels, len(self.train[0].channels))

    def _paths(self, model: Aligner) -> list[StatePath]:
        paths = [np.asarray(path) for path in model.path_]
        lengths = [(len(recording.times),) for recording in self.train]
        if [path.shape for path in paths] != lengths:
            raise InvalidPredictionError(
                "path_: expected a state for each frame of each recording, "
                f"got paths of shapes {[path.shape for path in paths]}"
            )
        states = np.concatenate(paths)
        if not np.isin(states, np.arange(model.cycle_length_)).all():
            raise InvalidPredictionError(
                f"path_: expected states 0 to {model.cycle_length_ - 1}, "
                f"got {states.min()} to {states.max()}"
            )
        return paths
