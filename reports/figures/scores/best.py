"""Which models a figure has room for: the best by a metric, of yours, and of interpolations."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from mocapbench.reports.analysis.results import TaskResults

__all__ = ["CHOICE", "best_labels", "mean_values"]

CHOICE = (
    "the models of the least mean, the best interpolation and, where there are any, the best of "
    "your own models"
)
"""What `best_labels` chooses, for captions."""


def mean_values(results: TaskResults, metric: str) -> dict[str, float]:
    """Return the mean over representative cases of each label that has a score in all of them."""
    n_cases = len(results.representative_cases(metric))
    found = {label: results.case_means(metric, label) for label in results.layout.labels}
    complete = {label: means for label, means in found.items() if means and len(means) == n_cases}
    return {label: float(np.mean(means)) for label, means in complete.items()}


def best_labels(results: TaskResults, metric: str, among: Iterable[str], most: int) -> list[str]:
    """Return ``most`` ranked labels of the least loss, then the best of yours and interpolation."""
    loss, means, known = results.metrics[metric].loss, mean_values(results, metric), set(among)
    order = sorted((name for name in means if name in known), key=lambda n: loss(means[n]))
    ranked = [label for label in order if label in results.layout.ranked][:most]
    yours = [label for label in order if label in results.layout.yours][:1]
    filling = [label for label in order if label in results.layout.interpolations][:1]
    return list(dict.fromkeys([*ranked, *yours, *filling]))
