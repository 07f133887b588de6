"""Paired contrasts of all pairs of entrants at once, by the units of the page.

The pairs of the best entrant with every complete other are one family, that of the standings
(`mocapbench.reports.analysis.standings`), and all other pairs are a second one. Every pair thus has
one interval and one p-value, wherever the page shows it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.metrics.statistics import ALPHA, UnitMeans, holm_tests_of_means, unit_means
from mocapbench.reports.analysis.cells import Cells

__all__ = ["PairContrast", "contrasts"]


@dataclass(frozen=True)
class PairContrast:
    """How much better one label is than another, over the units that both have.

    Parameters
    ----------
    n : int
        The number of units.
    first, second : float
        Mean values over the units; NaN where there is none.
    advantage : float
        By how much the first is better; negative where it is worse.
    low, high : float
        The interval of the advantage at the level at which Holm's method decides its test
        (`mocapbench.metrics.statistics.families`); NaN without a test.
    t_p, t_p_holm : float
        Two-sided p of the paired t-test, before and after Holm's correction over the family.
    """

    n: int
    first: float
    second: float
    advantage: float
    low: float
    high: float
    t_p: float
    t_p_holm: float

    @property
    def tested(self) -> bool:
        """Whether there are enough units for a test."""
        return not math.isnan(self.t_p)

    @property
    def separable(self) -> bool:
        """Whether the difference is more than chance; never without a test."""
        return self.t_p_holm <= ALPHA

    @property
    def reverse(self) -> PairContrast:
        """The contrast of the second label with the first."""
        return replace(
            self,
            first=self.second,
            second=self.first,
            advantage=-self.advantage,
            low=-self.high,
            high=-self.low,
        )


def contrasts(scored: Cells) -> Mapping[tuple[str, str], PairContrast]:
    """Return the contrasts of all pairs of labels, by the two labels in either order."""
    rows = np.array([*combinations(range(len(scored.labels)), 2)], dtype=int).reshape(-1, 2)
    if not rows.size:
        return {}
    n, first, second, mean, error, freedom = _samples(scored, rows)
    of_best = (rows == scored.best).any(axis=1) & scored.complete[rows].all(axis=1)
    tested = np.full((4, len(rows)), np.nan)
    for family in (of_best, ~of_best):
        means = UnitMeans(mean[family], error[family], freedom[family])
        found = holm_tests_of_means(means.drop_errors_of_few_units())
        tested[:, family] = found.low, found.high, found.uncorrected_p, found.p
    by_pair = {}
    for pair, count, values in zip(
        combinations(scored.labels, 2),
        n,
        zip(first, second, mean, *tested, strict=True),
        strict=True,
    ):
        contrast = PairContrast(int(count), *map(float, values))
        by_pair[pair], by_pair[pair[::-1]] = contrast, contrast.reverse
    return by_pair


def _samples(scored: Cells, rows: NDArray[np.int_]) -> Array:
    """Return units, means of both, and mean, error and freedom of advantages, of each pair.

    Pairs with scores in the same cells, usually all of them, are taken together.
    """
    shared = scored.scored[rows].all(axis=1)
    patterns, pattern_of = np.unique(shared, axis=0, return_inverse=True)
    found = np.full((6, len(rows)), np.nan)
    for number, kept in enumerate(patterns):
        chosen = np.flatnonzero(pattern_of.reshape(-1) == number)
        weights = scored.weights(kept)
        found[0, chosen] = weights.shape[0]
        if weights.shape[0]:
            shares: Array = weights.sum(axis=1)
            values, losses = (
                scored.by_unit(array, kept)[rows[chosen]]
                for array in (scored.values, scored.losses)
            )
            found[1:3, chosen] = (values @ shares).T
            advantages = unit_means(losses[:, 1] - losses[:, 0], shares)
            found[3:, chosen] = advantages.mean, advantages.error, advantages.freedom
    return found
