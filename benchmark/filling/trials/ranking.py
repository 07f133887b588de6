"""The ranking of models by their trials, and the choice of one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench.benchmark.filling.trials.scores import Scores
from mocapbench.metrics.statistics import ALPHA, holm_tests

__all__ = ["Ranking", "rank"]


@dataclass(frozen=True, eq=False)
class Ranking:
    """Models by their mean error over the same trial gaps, the best first.

    Parameters
    ----------
    order : tuple of str
        The models; the first is the choice.
    means : mapping of str to float
        The weighted mean error of each.
    scores : mapping of str to Scores
    n : int
        The number of trial gaps.
    sharing : tuple of str
        Models whose errors differ from those of the one with the least by no more than chance.
    """

    order: tuple[str, ...]
    means: Mapping[str, float]
    scores: Mapping[str, Scores]
    n: int
    sharing: tuple[str, ...]


def rank(scores: Mapping[str, Scores], weights: NDArray[np.float64]) -> Ranking:
    """Return the ranking of one or more models that answered the same trials.

    Of equal ones, that which comes first in ``scores`` is the better one.

    Parameters
    ----------
    scores : mapping of str to Scores
    weights : ndarray of shape (n,)
        How much each trial gap counts, 1 in the mean.
    """
    losses = pd.DataFrame({model: score.errors * weights for model, score in scores.items()})
    means = losses.mean()
    order = tuple(means.sort_values(kind="stable").index)
    means_by_model = {model: float(means[model]) for model in order}
    return Ranking(order, means_by_model, scores, len(losses), _sharing(losses[list(order)]))


def _sharing(losses: pd.DataFrame) -> tuple[str, ...]:
    """Return the first model, and those that the paired t-test does not separate from it.

    P-values are corrected by Holm's method. A single trial is no test: only an equal error shares.
    """
    best, *others = losses.columns
    if not others:
        return (best,)
    differences = (losses[others].to_numpy(float) - losses[[best]].to_numpy(float)).T
    alike = (holm_tests(differences).p > ALPHA) | ~differences.any(axis=1)
    return (best, *(model for model, shares in zip(others, alike, strict=True) if shares))
