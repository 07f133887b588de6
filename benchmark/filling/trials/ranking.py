"""The ranking of models by their trials, and the choice of one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import takewhile

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench.benchmark.filling.trials.scores import TrialScores
from mocapbench.metrics.statistics import ALPHA, holm_tests_of_means, too_few, unit_means

__all__ = ["Ranking", "rank"]

_NEAR = 1.5
"""Errors, relative to the least, up to which a model is a rival of the first."""


@dataclass(frozen=True, eq=False)
class Ranking:
    """Models by their mean error over the same trial gaps, the best first.

    Parameters
    ----------
    order : tuple of str
        The models; the first is the choice.
    means : mapping of str to float
        The weighted mean error of each.
    scores : mapping of str to TrialScores
    n, n_places : int
        The number of trial gaps, and that of the places where they are.
    tested : bool
        Whether there are enough places to tell what is chance; a few that most trial gaps share are
        not.
    sharing : tuple of str
        Models whose errors differ from those of the one with the least by no more than chance, that
        one first. Of too few places nothing can be told: the first alone.
    """

    order: tuple[str, ...]
    means: Mapping[str, float]
    scores: Mapping[str, TrialScores]
    n: int
    n_places: int
    tested: bool
    sharing: tuple[str, ...]

    @property
    def rivals(self) -> tuple[str, ...]:
        """The models next to the first that no test separates from it, and that err little more.

        Where errors differ much from gap to gap, no test separates some that err ten times as much,
        or that are behind others which are separated.
        """
        most = _NEAR * self.means[self.order[0]]
        alike = takewhile(lambda model: model in self.sharing, self.order[1:])
        return tuple(model for model in alike if self.means[model] <= most)


def rank(
    scores: Mapping[str, TrialScores], weights: NDArray[np.float64], places: NDArray[np.intp]
) -> Ranking:
    """Return the ranking of one or more models that answered the same trials.

    Of equal ones, that which comes first in ``scores`` is the better one.

    Parameters
    ----------
    scores : mapping of str to TrialScores
    weights : ndarray of shape (n,)
        How much each trial gap counts, 1 in the mean.
    places : ndarray of int of shape (n,)
        Where each is: those at the same place are one unit of the test.
    """
    losses = pd.DataFrame({model: score.errors * weights for model, score in scores.items()})
    means = losses.mean()
    order = tuple(means.sort_values(kind="stable").index)
    by_place = losses[list(order)].groupby(places)
    shares = by_place.size().to_numpy(float) / len(losses)
    found = by_place.mean()
    tested = not too_few(unit_means(found.to_numpy(float).T, shares).freedom).any()
    return Ranking(
        order,
        {model: float(means[model]) for model in order},
        scores,
        len(losses),
        len(shares),
        tested,
        _sharing(found, shares) if tested else order[:1],
    )


def _sharing(losses: pd.DataFrame, shares: NDArray[np.float64]) -> tuple[str, ...]:
    """Return the first model, and those that the paired t-test does not separate from it.

    P-values are corrected by Holm's method.
    """
    best, *others = losses.columns
    differences = losses[others].sub(losses[best], axis=0).to_numpy(float).T
    alike = holm_tests_of_means(unit_means(differences, shares)).p > ALPHA
    return (best, *(model for model, is_alike in zip(others, alike, strict=True) if is_alike))
