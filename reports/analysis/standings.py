"""Where each label stands against the best one: the one comparison that the page makes.

The best label has the least mean loss over cases (`mocapbench.reports.analysis.units`) among the
labels with the most scores. Every other label that has all of its scores is compared with it, and
only with it, so that no two labels are ever said to be alike. Of labels that cannot be told from
the best, one may well be better than another.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.basics.words import format_count
from mocapbench.metrics.statistics import FEWEST_UNITS, holm_tests_of_means, unit_means
from mocapbench.reports.analysis.cells import Cells, cells
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout

__all__ = [
    "MOST_LEVEL",
    "Place",
    "Standing",
    "level_with_best",
    "next_best",
    "standings",
    "too_few_units",
]

MOST_LEVEL = 3
"""Labels that are named at most where their means are the same."""


class Place(Enum):
    """How a label stands against the best one."""

    BEST = "best"
    INSEPARABLE = "may be chance"
    BEHIND = "more than chance"
    UNTESTED = "too few to test"
    INCOMPLETE = "incomplete"


@dataclass(frozen=True)
class Standing:
    """One label against the best one.

    Parameters
    ----------
    label : str
    mean : float
        Of the metric, over the cases where the label has scores, each weighing the same.
    n_cases, n_units : int
        In how many cases and units it has scores.
    n_folds : int
        In how many folds of cases it has a score, of those where the best one has.
    unit : str
        What a unit is: ``"subject"``, ``"fold"`` or ``"case"``.
    complete : bool
        Whether it has a score in every case and fold where the best one has.
    difference : float
        How much greater its mean loss is than that of the best; 0 for the best, NaN where it is
        incomplete.
    low, high : float
        The interval of the difference by Student's t at the level at which Holm's method decides
        its test (`mocapbench.metrics.statistics.families`): it includes 0 where the difference may
        be chance. NaN where there is no test.
    standing : Place
    """

    label: str
    mean: float
    n_cases: int
    n_units: int
    n_folds: int
    unit: str
    complete: bool
    difference: float
    low: float
    high: float
    standing: Place

    @property
    def units(self) -> str:
        """Over how many units it is: ``"4 subjects"``."""
        return format_count(self.n_units, self.unit)

    @property
    def finding(self) -> str:
        """What the page says of it, with the number of units where they are too few."""
        if self.standing is Place.UNTESTED:
            return too_few_units(self.n_units, self.unit)
        return str(self.standing.value)


def too_few_units(n: int, unit: str) -> str:
    """Return what the page says of units that are too few, by number or as shares are unequal."""
    unequal = " of unequal weight" if n >= FEWEST_UNITS else ""
    return f"{Place.UNTESTED.value} ({format_count(n, unit)}{unequal})"


def standings(
    results: TaskResults, metric: str, cases: Sequence[CaseLayout] | None = None
) -> tuple[Standing, ...]:
    """Return how every ranked label with a score stands, best first, incomplete ones last.

    Parameters
    ----------
    results : TaskResults
    metric : str
    cases : sequence of CaseLayout or None
        By default the representative cases; one case for a row of a table. The tests of one call
        are one family.
    """
    return _standings(cells(results, metric, cases))


def level_with_best(found: Sequence[Standing]) -> list[Standing]:
    """Return the other standings whose mean is the best one's, to rounding; complete ones alone.

    Parameters
    ----------
    found : sequence of Standing
        As `standings` returns them, one or more.
    """
    best, *others = found
    return [one for one in others if one.complete and math.isclose(one.mean, best.mean)]


def next_best(found: Sequence[Standing]) -> Standing | None:
    """Return the best of those that have every score and another mean than the first.

    Parameters
    ----------
    found : sequence of Standing
        As `standings` returns them, one or more.
    """
    level = level_with_best(found)
    return next((one for one in found[1:] if one.complete and one not in level), None)


def _standings(scored: Cells) -> tuple[Standing, ...]:
    if not scored.labels:
        return ()
    best, complete = scored.best, scored.complete
    kept = scored.scored[best]
    shares: Array = scored.weights(kept).sum(axis=1)
    losses = scored.by_unit(scored.losses, kept)
    others = np.arange(len(losses)) != best
    differences = losses - losses[best]
    low, high, separable = _test_rivals(differences, shares, complete & others)
    mean = differences @ shares
    places = _places(others, complete, separable, np.isfinite(low))
    order = np.lexsort((mean, others, ~complete)).tolist()
    intervals = np.stack([mean, low, high], axis=1).tolist()
    return tuple(_standing(scored, row, intervals[row], places[row]) for row in order)


def _standing(scored: Cells, row: int, interval: Sequence[float], place: Place) -> Standing:
    difference, low, high = interval
    return Standing(
        label=scored.labels[row],
        mean=scored.mean(row),
        n_cases=scored.n_cases(row),
        n_units=scored.n_units(row),
        n_folds=int((scored.scored[row] & scored.scored[scored.best]).sum()),
        unit=scored.unit,
        complete=bool(scored.complete[row]),
        difference=difference,
        low=low,
        high=high,
        standing=place,
    )


def _test_rivals(
    differences: Array, shares: Array, rivals: NDArray[np.bool_]
) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Return intervals, NaN of too few units, and whether 0 is outside, of ``rivals``."""
    low, high = np.full((2, len(rivals)), np.nan)
    separable = np.zeros(len(rivals), dtype=bool)
    found = holm_tests_of_means(unit_means(differences[rivals], shares).drop_errors_of_few_units())
    low[rivals], high[rivals], separable[rivals] = found.low, found.high, found.separable
    return low, high, separable


def _places(
    others: NDArray[np.bool_],
    complete: NDArray[np.bool_],
    separable: NDArray[np.bool_],
    tested: NDArray[np.bool_],
) -> list[Place]:
    conditions = [~others, ~complete, ~tested, separable]
    places = [Place.BEST, Place.INCOMPLETE, Place.UNTESTED, Place.BEHIND]
    return [
        next((place for place, holds in zip(places, row, strict=True) if holds), Place.INSEPARABLE)
        for row in zip(*conditions, strict=True)
    ]
