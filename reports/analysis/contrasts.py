"""Paired contrasts of many pairs of entrants at once, by the units of the page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import special

from mocapbench.metrics.statistics import ALPHA, ROPE, holm_tests_of_means
from mocapbench.reports.analysis.cells import Cells
from mocapbench.reports.analysis.grid import Array
from mocapbench.reports.analysis.units import FEWEST_UNITS

__all__ = ["PairContrast", "contrasts"]


@dataclass(frozen=True)
class PairContrast:
    """How much better one label is than another, over the units that both have.

    Parameters
    ----------
    n : int
        The number of units; below `FEWEST_UNITS` nothing is tested.
    first, second : float
        Mean values over the units; NaN where there is none.
    advantage : float
        By how much the first is better; negative where it is worse.
    low, high : float
        The interval of the advantage at the level at which Holm's method decides its test
        (`mocapbench.metrics.statistics.families`); NaN without a test.
    t_p, t_p_holm : float
        Two-sided p of the paired t-test, before and after Holm's correction over the family.
    better, equivalent, worse : float
        Probabilities by the Bayesian correlated t-test; equivalent is within 2 %.
    """

    n: int
    first: float
    second: float
    advantage: float
    low: float
    high: float
    t_p: float
    t_p_holm: float
    better: float
    equivalent: float
    worse: float

    @property
    def tested(self) -> bool:
        """Whether there are enough units for a test."""
        return self.n >= FEWEST_UNITS

    @property
    def separable(self) -> bool:
        """Whether the difference is more than chance; never without a test."""
        return self.t_p_holm <= ALPHA


def contrasts(scored: Cells, pairs: Sequence[tuple[str, str]]) -> list[PairContrast]:
    """Return the contrasts of ``pairs`` of labels, one family."""
    if not pairs:
        return []
    rows = np.array([[scored.labels.index(label) for label in pair] for pair in pairs])
    n, first, second, mean, deviation, size = _samples(scored, rows)
    enough = n >= FEWEST_UNITS
    errors = np.where(enough, deviation / np.sqrt(np.maximum(n, 1)), np.nan)
    tested = holm_tests_of_means(mean, errors, n)
    better, worse = _posterior(mean, deviation, np.where(enough, n, np.nan), ROPE * size)
    columns = (
        *(first, second, mean, tested.low, tested.high, tested.uncorrected_p, tested.p),
        *(better, 1.0 - better - worse, worse),
    )
    return [
        PairContrast(int(count), *map(float, values))
        for count, values in zip(n, np.transpose(columns), strict=True)
    ]


def _samples(scored: Cells, rows: NDArray[np.int_]) -> tuple[Array, ...]:
    """Return units, means of both, mean and deviation of advantages, and mean size of values.

    Pairs with scores in the same cells, usually all of them, are taken together.
    """
    shared = scored.scored[rows].all(axis=1)
    patterns, pattern_of = np.unique(shared, axis=0, return_inverse=True)
    found = np.full((6, len(rows)), np.nan)
    for number, kept in enumerate(patterns):
        chosen = np.flatnonzero(pattern_of.reshape(-1) == number)
        weights = scored.weights(kept)
        found[0, chosen] = len(weights)
        if len(weights):
            values, losses = (
                array[:, kept][rows[chosen]] @ weights.T for array in (scored.values, scored.losses)
            )
            found[1:, chosen] = _summaries(values, losses[:, 1] - losses[:, 0])
    return tuple(found)


def _summaries(values: Array, advantages: Array) -> Array:
    """Return what `_samples` does for pairs with ``values`` of shape (n_pairs, 2, n_units)."""
    deviation = advantages.std(axis=1, ddof=1) if advantages.shape[1] > 1 else np.nan
    equal = np.ptp(advantages, axis=1) == 0.0
    return np.stack(
        [
            *values.mean(axis=2).T,
            np.where(equal, advantages[:, 0], advantages.mean(axis=1)),
            np.where(equal & (advantages.shape[1] > 1), 0.0, deviation),
            np.abs(values).mean(axis=(1, 2)),
        ]
    )


def _posterior(mean: Array, deviation: Array, n: Array, rope: Array) -> tuple[Array, Array]:
    """Return the probabilities of better and worse by the correlated t-test, ρ = 1/n.

    See Also
    --------
    mocapbench.metrics.statistics.correlated_t_test : the same for a single sample.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = deviation * np.sqrt(1.0 / n + 1.0 / (n - 1.0))
        # Where all advantages are equal the quotient is infinite, or 0/0 on the region's edge.
        upper, lower = ((mean - rope) / scale, (-mean - rope) / scale)
    return tuple(  # type: ignore[return-value]
        np.where(np.isnan(t) & np.isfinite(n), 0.0, special.stdtr(n - 1.0, t))
        for t in (upper, lower)
    )
