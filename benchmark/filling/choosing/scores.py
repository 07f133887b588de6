"""Errors of predictions in held-out gaps, relative to those of holding the last visible value."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.filling.choosing.hold_outs import HoldOut
from mocapbench.benchmark.filling.gap_problem import PredictedEntries

__all__ = ["score_gaps", "score_holding", "score_units", "weigh_gaps"]


_LEAST = 1e-9
"""Errors, relative to those of holding, below which models are equally good but for rounding."""


def weigh_gaps(hold_outs: Sequence[HoldOut]) -> Array:
    """Return the weight of each held-out gap (n,), 1 in the mean.

    A real gap counts by its entries, as it does in the file; its copies share its weight.
    """
    originals = [original for hold_out in hold_outs for original in hold_out.originals]
    copies = Counter(originals)
    weights = np.array([original.n_entries / copies[original] for original in originals])
    return np.asarray(weights / weights.mean())


def score_holding(hold_outs: Sequence[HoldOut]) -> Mapping[str, float]:
    """Return, by unit, the error of holding each channel's last visible value in held-out gaps.

    That is the root mean squared error over the entries in that unit, as in the scaled errors of
    Hyndman and Koehler (2006, *International Journal of Forecasting* 22:679–688); 1 where nothing
    moves, or nothing is visible to hold. The spread of a channel would not do: the position of a
    person who walks far has a large one, beside which errors in position would not count.
    """
    squares = pd.concat(
        pd.Series((_hold_values(one) - one.truth) ** 2, index=_list_units(one)) for one in hold_outs
    )
    means = squares.groupby(level=0).mean()
    return {str(unit): float(np.sqrt(mean)) if mean > 0.0 else 1.0 for unit, mean in means.items()}


def _hold_values(hold_out: HoldOut) -> Array:
    """Return the last visible value before each wanted entry (M,), or the first after it."""
    held = pd.DataFrame(hold_out.problem.given.values).ffill().bfill()
    return np.asarray(held, dtype=float)[hold_out.problem.target]


def score_gaps(
    hold_outs: Sequence[HoldOut],
    predictions: Sequence[PredictedEntries],
    scales: Mapping[str, float],
) -> Array:
    """Return the error of a model in each gap (n,) of the first hold-outs.

    It is the mean over units of the root mean squared error over the gap's entries in that unit,
    relative to the scale of the unit, as `score_holding` returns it. So three channels of position
    count as much as sixty angles, however far the person travels.
    """
    pairs = zip(hold_outs, predictions, strict=False)
    return np.array([error for pair in pairs for error in _score_hold_out(*pair, scales)])


def _score_hold_out(
    hold_out: HoldOut, prediction: PredictedEntries, scales: Mapping[str, float]
) -> Iterator[float]:
    units = _list_units(hold_out)
    squares = (prediction.mean - hold_out.truth) ** 2
    for gap in hold_out.entries:
        errors = [
            np.sqrt(squares[gap][units[gap] == unit].mean()) / scales[unit]
            for unit in np.unique(units[gap]).tolist()
        ]
        yield float(np.maximum(errors, _LEAST).mean())


def score_units(
    hold_outs: Sequence[HoldOut], predictions: Sequence[PredictedEntries]
) -> Mapping[str, float]:
    """Return, by unit, the root mean squared error over all entries of the first hold-outs."""
    squares: dict[str, list[Array]] = {}
    for hold_out, prediction in zip(hold_outs, predictions, strict=False):
        units = _list_units(hold_out)
        for unit in dict.fromkeys(units.tolist()):
            chosen = units == unit
            squares.setdefault(unit, []).append((prediction.mean - hold_out.truth)[chosen] ** 2)
    return {unit: float(np.sqrt(np.concatenate(parts).mean())) for unit, parts in squares.items()}


def _list_units(hold_out: HoldOut) -> NDArray[np.str_]:
    """Return the unit of each wanted entry (M,)."""
    _, channels = np.nonzero(hold_out.problem.target)
    return np.array(hold_out.problem.given.units)[channels]
