"""Critical differences of mean ranks: Friedman's test, then Nemenyi's.

Pairwise signed-rank tests with Holm's correction, the usual alternative, cannot separate any two of
eight entrants over nine cases: the least p, 2⁻⁸, is multiplied by 28. Nemenyi's test can, and its
single critical difference can be drawn to scale in a diagram.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import stats

from mocapbench.metrics.statistics.differences import ALPHA

__all__ = ["friedman", "group_ranks", "mean_ranks", "nemenyi"]

FEWEST_ENTRANTS, FEWEST_BLOCKS = 3, 2


def mean_ranks(losses: ArrayLike) -> tuple[float, ...]:
    """Return the mean rank of each entrant over blocks.

    1 is best; ties share the mean of their ranks.

    Parameters
    ----------
    losses : array-like of shape (n, k)
        Lower is better; a row is a block (a case, a task), a column an entrant.

    Raises
    ------
    ValueError
        If there are fewer than two blocks or three entrants, or a value is not finite.

    References
    ----------
    J. Demšar (2006). Statistical comparisons of classifiers over multiple data sets. JMLR 7,
    §3.2.2.
    """
    return tuple(_rank_entrants(losses).mean(axis=0).tolist())


def friedman(losses: ArrayLike) -> float:
    """Return the p-value of Friedman's test (χ², corrected for ties) that all rank alike.

    1 if all is tied.

    Parameters
    ----------
    losses : array-like of shape (n, k)
        As for `mean_ranks`.

    Raises
    ------
    ValueError
        As `mean_ranks`.
    """
    ranks = _rank_entrants(losses)
    if np.ptp(ranks, axis=1).max() == 0.0:
        return 1.0
    return float(stats.friedmanchisquare(*ranks.T).pvalue)


@cache
def nemenyi(n: int, k: int) -> float:
    """Return the critical difference of the mean ranks of ``k`` entrants over ``n`` blocks.

    q √(k (k + 1) / 6n), with q the upper 5 % point of the Studentised range of k, over √2.
    """
    quantile = float(stats.studentized_range.ppf(1.0 - ALPHA, k, np.inf)) / math.sqrt(2.0)
    return quantile * math.sqrt(k * (k + 1) / (6.0 * n))


def group_ranks(
    ranks: Sequence[float], difference: float, p_value: float
) -> tuple[tuple[int, ...], ...]:
    """Return the largest sets of two or more entrants whose ranks do not differ significantly.

    Best first. All entrants are one group if Friedman's test finds no difference.

    Parameters
    ----------
    ranks : sequence of float
        The mean rank of each entrant.
    difference : float
        Nemenyi's critical difference.
    p_value : float
        Friedman's test that all entrants rank alike.
    """
    order = sorted(range(len(ranks)), key=ranks.__getitem__)
    if p_value > ALPHA:
        return (tuple(order),)
    ordered = np.array([ranks[entrant] for entrant in order])
    ends = np.searchsorted(ordered, ordered + difference, side="right")
    new = np.concatenate([[True], ends[1:] > ends[:-1]])
    runs = [tuple(order[i : ends[i]]) for i in np.flatnonzero(new)]
    return tuple(run for run in runs if len(run) > 1)


def _rank_entrants(losses: ArrayLike) -> NDArray[np.float64]:
    table = np.asarray(losses, dtype=float)
    if table.ndim != 2 or table.shape[0] < FEWEST_BLOCKS or table.shape[1] < FEWEST_ENTRANTS:
        raise ValueError(
            f"expected {FEWEST_BLOCKS} or more blocks by {FEWEST_ENTRANTS} or more entrants, "
            f"got shape {table.shape}; two entrants are compared by `contrast`"
        )
    if not np.isfinite(table).all():
        raise ValueError("expected finite losses, got NaN or infinity: leave out that entrant")
    return np.asarray(stats.rankdata(table, axis=1))
