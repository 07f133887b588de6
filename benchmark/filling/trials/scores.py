"""Scores of trials: an error of each trial gap, relative to that of holding the last pose."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.filling.question import FilledEntries
from mocapbench.benchmark.filling.trials.trial import Trial

__all__ = ["TrialScores", "held_errors", "scores_of", "weights_of"]


_LEAST = 1e-9
"""Errors, relative to those of holding, below which models are equally good but for rounding."""


@dataclass(frozen=True, eq=False)
class TrialScores:
    """How a model filled the trial gaps.

    Parameters
    ----------
    errors : ndarray of shape (n,)
        One per trial gap: the mean over units of the root mean squared error over its entries in
        that unit, relative to `held_errors`. So three channels of place count as much as sixty
        angles, however far the person travels.
    rmse : mapping of str to float
        By unit, the root mean squared error over all entries, in that unit.
    has_bands : bool
        Whether the model has a predictive distribution.
    """

    errors: Array
    rmse: Mapping[str, float]
    has_bands: bool


def weights_of(trials: Sequence[Trial]) -> Array:
    """Return the weight of each trial gap (n,), 1 in the mean.

    A real gap counts by its entries, as it does in the file; its copies share its weight.
    """
    originals = [original for trial in trials for original in trial.originals]
    copies = Counter(originals)
    weights = np.array([original.n_entries / copies[original] for original in originals])
    return np.asarray(weights / weights.mean())


def held_errors(trials: Sequence[Trial]) -> Mapping[str, float]:
    """Return, by unit, the error of holding each channel's last visible value in trial gaps.

    That is the root mean squared error over the entries in that unit, as in the scaled errors of
    Hyndman and Koehler (2006, *International Journal of Forecasting* 22:679–688); 1 where nothing
    moves, or nothing is visible to hold. The spread of a channel would not do: the place of a
    person who walks far has a large one, beside which errors in place would not count.
    """
    squares = pd.concat(
        pd.Series((_held(trial) - trial.truth) ** 2, index=_units(trial)) for trial in trials
    )
    means = squares.groupby(level=0).mean()
    return {str(unit): float(np.sqrt(mean)) if mean > 0.0 else 1.0 for unit, mean in means.items()}


def _held(trial: Trial) -> Array:
    """Return the last visible value before each wanted entry (M,), or the first after it."""
    held = pd.DataFrame(trial.question.given.values).ffill().bfill()
    return np.asarray(held, dtype=float)[trial.question.target]


def scores_of(
    trials: Sequence[Trial], answers: Sequence[FilledEntries], scales: Mapping[str, float]
) -> TrialScores:
    """Return the scores of a model's answers to the first trials, relative to scales by unit."""
    pairs = list(zip(trials, answers, strict=False))
    return TrialScores(
        np.array([error for pair in pairs for error in _errors(*pair, scales)]),
        _by_unit(pairs),
        all(answer.variance is not None for answer in answers),
    )


def _errors(trial: Trial, answer: FilledEntries, scales: Mapping[str, float]) -> Iterator[float]:
    units = _units(trial)
    squares = (answer.mean - trial.truth) ** 2
    for gap in trial.units:
        errors = [
            np.sqrt(squares[gap][units[gap] == unit].mean()) / scales[unit]
            for unit in np.unique(units[gap]).tolist()
        ]
        yield float(np.maximum(errors, _LEAST).mean())


def _units(trial: Trial) -> NDArray[np.str_]:
    """Return the unit of each wanted entry (M,)."""
    _, channels = np.nonzero(trial.question.target)
    return np.array(trial.question.given.units)[channels]


def _by_unit(pairs: Sequence[tuple[Trial, FilledEntries]]) -> Mapping[str, float]:
    squares: dict[str, list[Array]] = {}
    for trial, answer in pairs:
        units = _units(trial)
        for unit in dict.fromkeys(units.tolist()):
            chosen = units == unit
            squares.setdefault(unit, []).append((answer.mean - trial.truth)[chosen] ** 2)
    return {unit: float(np.sqrt(np.concatenate(parts).mean())) for unit, parts in squares.items()}
