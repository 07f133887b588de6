"""The ranking of models by their errors in held-out gaps, and whether its lead is chance.

In a short recording, or with long gaps, held-out gaps overlap: fifteen of 60 frames may lie at two
positions, a frame or two apart. Their errors are then nearly the same, and no more evidence than
two are. So the test counts independent positions: gaps at one position are one unit of it.

Held-out gaps that are linked by others in between need not be at one position: 24 of 90 frames may
cover a recording of 600 frames without a break. A position is therefore a held-out gap with those
that share frames with it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import takewhile

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Array, Index
from mocapbench.benchmark.filling.choosing.hold_outs import HeldOutGap
from mocapbench.benchmark.filling.gaps import Gap
from mocapbench.metrics.statistics import (
    ALPHA,
    FEWEST_UNITS,
    UnitMeans,
    holm_tests_of_means,
    too_few,
    unit_means,
)

__all__ = ["Ranking", "number_positions", "rank", "share_evidence", "tell_positions"]

_NEAR = 1.5
"""Errors, relative to the least, up to which a model is a rival of the first."""
_BESIDE = 1
"""Frames on each side that belong to a held-out gap: what is filled goes on from them."""


@dataclass(frozen=True, eq=False)
class Ranking:
    """Models by their mean error over the same held-out gaps, the best first.

    Parameters
    ----------
    order : tuple of str
        The models; the first is the choice. Where others of the same unit are drawn upon, it need
        not be the one with the least error.
    means : mapping of str to float
        The weighted mean error of each.
    intervals : mapping of str to (float, float)
        The 95 % interval of each mean, by Student's t; NaN where positions are too few.
    errors : mapping of str to ndarray of shape (n,)
        The error of each in each held-out gap.
    n_gaps, n_positions : int
        The number of held-out gaps, and that of their independent positions.
    tested : bool
        Whether there are enough positions to tell what is chance; a few that most held-out gaps
        share are not.
    sharing : tuple of str
        Models whose errors differ from those of the one with the least by no more than chance, that
        one first. Of too few positions nothing can be told: the first alone.
    """

    order: tuple[str, ...]
    means: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]]
    errors: Mapping[str, Array]
    n_gaps: int
    n_positions: int
    tested: bool
    sharing: tuple[str, ...]

    @property
    def least(self) -> str:
        """The model with the least error."""
        return min(self.order, key=self.means.__getitem__)

    @property
    def near(self) -> tuple[str, ...]:
        """The models that err little more than the first, which are that one and others."""
        most = _NEAR * self.means[self.least]
        return tuple(model for model in self.order if self.means[model] <= most)

    @property
    def rivals(self) -> tuple[str, ...]:
        """The models next to the first that no test separates from it, and that err little more.

        Where errors differ much from gap to gap, no test separates some that err ten times as much,
        or that are behind others which are separated.
        """
        alike = takewhile(lambda model: model in self.sharing, self.order[1:])
        return tuple(model for model in alike if model in self.near)


def rank(errors: Mapping[str, Array], weights: Array, positions: Index) -> Ranking:
    """Return the ranking of one or more models that filled the same hold-outs.

    Of equal ones, that which comes first in ``errors`` is the better one.

    Parameters
    ----------
    errors : mapping of str to ndarray of shape (n,)
        Of each model, in each held-out gap.
    weights : ndarray of shape (n,)
        How much each held-out gap counts, 1 in the mean.
    positions : ndarray of int of shape (n,)
        Where each is: those at the same position are one unit of the test.
    """
    losses = pd.DataFrame({model: each * weights for model, each in errors.items()})
    means = losses.mean()
    order = tuple(means.sort_values(kind="stable").index)
    by_position = losses[list(order)].groupby(positions)
    shares = by_position.size().to_numpy(float) / len(losses)
    found = by_position.mean()
    by_model = unit_means(found.to_numpy(float).T, shares)
    tested = not too_few(by_model.freedom).any()
    return Ranking(
        order,
        {model: float(means[model]) for model in order},
        dict(zip(order, _bound_means(by_model), strict=True)),
        errors,
        len(losses),
        len(shares),
        tested,
        _find_models_alike(found, shares) if tested else order[:1],
    )


def _bound_means(means: UnitMeans) -> list[tuple[float, float]]:
    """Return the 95 % interval of each of some mean errors, which are not below 0."""
    half = means.drop_errors_of_few_units().half_widths(ALPHA)
    low, high = np.maximum(means.mean - half, 0.0), means.mean + half
    return [*zip(low.tolist(), high.tolist(), strict=True)]


def share_evidence(ranking: Ranking, others: Sequence[Ranking]) -> Ranking:
    """Return a ranking in whose order the errors in gaps of other kinds count, too.

    A kind with few independent positions says little by itself. The logarithm of a model's mean
    error is a mean of that in the kind itself, by the number of its positions, and that in all
    kinds, which counts as many positions as a test needs. A model that the test finds worse in the
    kind itself comes no further forward.

    Parameters
    ----------
    ranking : Ranking
    others : sequence of Ranking
        Of the same models in gaps of the same unit, that one among them.
    """
    own, *all_kinds = (_take_logarithms(one, ranking.order) for one in (ranking, *others))
    pooled = np.average(all_kinds, axis=0, weights=[one.n_positions for one in others])
    n = ranking.n_positions
    scores = (n * own + FEWEST_UNITS * pooled) / (n + FEWEST_UNITS)
    able = ranking.sharing if ranking.tested else ranking.order
    places = sorted(range(len(scores)), key=lambda k: (ranking.order[k] not in able, scores[k]))
    return replace(ranking, order=tuple(ranking.order[k] for k in places))


def _take_logarithms(ranking: Ranking, order: Sequence[str]) -> Array:
    """Return the logarithm of each model's mean error, 0 in their mean."""
    errors = np.log([max(ranking.means[model], np.finfo(float).tiny) for model in order])
    return np.asarray(errors - errors.mean())


def _find_models_alike(losses: pd.DataFrame, shares: Array) -> tuple[str, ...]:
    """Return the first model, and those that the paired t-test does not separate from it.

    P-values are corrected by Holm's method.
    """
    best, *others = losses.columns
    differences = losses[others].sub(losses[best], axis=0).to_numpy(float).T
    alike = holm_tests_of_means(unit_means(differences, shares)).p > ALPHA
    return (best, *(model for model, is_alike in zip(others, alike, strict=True) if is_alike))


def number_positions(gaps: Sequence[HeldOutGap]) -> Index:
    """Return the position of each held-out gap (n,), see `tell_positions`."""
    return tell_positions([gap.copy for gap in gaps])


def tell_positions(gaps: Sequence[Gap]) -> Index:
    """Return the position of each gap (n,), numbered along the recording from 0.

    The first gaps to end at each position share no frames with each other, and there are as many of
    them as there can be.
    """
    positions = np.empty(len(gaps), dtype=np.intp)
    position, stop = -1, -np.inf
    for number in sorted(range(len(gaps)), key=lambda n: gaps[n].stop):
        if gaps[number].start - _BESIDE >= stop:
            position, stop = position + 1, gaps[number].stop + _BESIDE
        positions[number] = position
    return positions
