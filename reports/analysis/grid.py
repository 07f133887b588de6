"""The scores of a task as one array."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Array
from mocapbench.metrics.base import Direction
from mocapbench.reports.bundle.metric_info import MetricInfo

__all__ = ["Grid", "linear_losses"]


@dataclass(frozen=True, eq=False)
class Grid:
    """Scores by metric, label, case and fold.

    Parameters
    ----------
    metrics, labels, cases : tuple of str
    folds : tuple of int
        The names along the axes, the last three in table order.
    values, sample_two_sd : ndarray of shape (n_metrics, n_labels, n_cases, n_folds)
        NaN where there is none.
    """

    metrics: tuple[str, ...]
    labels: tuple[str, ...]
    cases: tuple[str, ...]
    folds: tuple[int, ...]
    values: Array
    sample_two_sd: Array

    @classmethod
    def of(cls, scores: pd.DataFrame, labels: Sequence[str], cases: Sequence[str]) -> Grid:
        """Return the grid of a task's rows of the bundle's scores.

        Parameters
        ----------
        scores : DataFrame
            Columns ``metric``, ``label``, ``case``, ``fold``, ``value`` and ``sample_two_sd``.
        labels, cases : sequence of str
            All that the task has, in table order; those without a score have no place.
        """
        names = (
            tuple(pd.unique(scores["metric"])),
            _present(labels, scores["label"]),
            _present(cases, scores["case"]),
            tuple(sorted(pd.unique(scores["fold"]))),
        )
        axes = zip(("metric", "label", "case", "fold"), names, strict=True)
        index = tuple(pd.Index(known).get_indexer(scores[axis]) for axis, known in axes)
        arrays = []
        for column in ("value", "sample_two_sd"):
            array = np.full(tuple(map(len, names)), np.nan)
            array[index] = scores[column].to_numpy(float)
            arrays.append(array)
        return cls(*names, *arrays)

    def select(self, metric: str, labels: Iterable[str], cases: Iterable[str]) -> Array:
        """Return the values of ``metric``, of shape (n_labels, n_cases, n_folds)."""
        if metric not in self.metrics:
            return np.full((len([*labels]), len([*cases]), len(self.folds)), np.nan)
        rows = [self.labels.index(label) for label in labels]
        columns = [self.cases.index(case) for case in cases]
        return np.asarray(self.values[self.metrics.index(metric)][np.ix_(rows, columns)])


def _present(known: Sequence[str], used: pd.Series[str]) -> tuple[str, ...]:
    present = set(pd.unique(used))
    return tuple(name for name in known if name in present)


def linear_losses(values: Array, info: MetricInfo) -> Array:
    """Return losses whose mean over the folds of a case is the loss of the mean.

    Where the metric has a target, the loss is the distance from it on the side where the mean of
    the case lies: above it, what a fold has more; below it, what it has less.
    """
    if info.direction is not Direction.TARGET or info.target is None:
        return np.asarray(info.loss(1.0) * values)
    finite = np.isfinite(values)
    distance = np.where(finite, values - info.target, 0.0).sum(axis=-1, keepdims=True)
    return np.where(distance < 0.0, -1.0, 1.0) * (values - info.target)
