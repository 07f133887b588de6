"""Scores of trials: an error of each trial gap, in which each unit of channels counts alike."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from mocapbench.benchmark.filling.question import Answer
from mocapbench.benchmark.filling.trials.making import Trial

__all__ = ["Scores", "scores_of", "weights_of"]

Array = NDArray[np.float64]

_WITHIN_95 = float(ndtri(0.975))
_LEAST = 1e-9
"""Errors, in units of a channel's scale, below which models are equally good but for rounding."""
_SHARE = 1e-3
"""Of the error in another unit, that an error counts as at least: no unit outweighs all others."""


@dataclass(frozen=True, eq=False)
class Scores:
    """How a model filled the trial gaps.

    Parameters
    ----------
    errors : ndarray of shape (n,)
        One per trial gap: the geometric mean over units of the root mean squared error over its
        entries in that unit, divided by their scale. So a few channels in centimetres count as much
        as many in degrees, and twice the error in either is as bad, unless it is a thousandth of
        the other.
    rmse : mapping of str to float
        By unit, the root mean squared error over all entries, in that unit.
    coverage : float or None
        The share of entries inside their 95 % bands; None if the model has none.
    """

    errors: Array
    rmse: Mapping[str, float]
    coverage: float | None


def weights_of(trials: Sequence[Trial]) -> Array:
    """Return the weight of each trial gap (n,), 1 in the mean.

    A real gap counts by its entries, as it does in the file; its copies share its weight.
    """
    originals = [original for trial in trials for original in trial.originals]
    copies = Counter(originals)
    weights = np.array([original.n_entries / copies[original] for original in originals])
    return np.asarray(weights / weights.mean())


def scores_of(trials: Sequence[Trial], answers: Sequence[Answer], scale: Array) -> Scores:
    """Return the scores of a model's answers to the first trials."""
    pairs = list(zip(trials, answers, strict=False))
    return Scores(
        np.array([error for pair in pairs for error in _errors(*pair, scale)]),
        _by_unit(pairs),
        _coverage(pairs),
    )


def _errors(trial: Trial, answer: Answer, scale: Array) -> Iterator[float]:
    _, channels = np.nonzero(trial.question.target)
    units = np.array(trial.question.given.units)[channels]
    squares = ((answer.mean - trial.truth) / scale[channels]) ** 2
    for gap in trial.units:
        means = [squares[gap][units[gap] == unit].mean() for unit in np.unique(units[gap])]
        errors = np.sqrt(means)
        yield float(np.exp(np.log(np.maximum(errors, max(_LEAST, _SHARE * errors.max()))).mean()))


def _by_unit(pairs: Sequence[tuple[Trial, Answer]]) -> Mapping[str, float]:
    squares: dict[str, list[Array]] = {}
    for trial, answer in pairs:
        _, channels = np.nonzero(trial.question.target)
        units = np.array(trial.question.given.units)[channels]
        for unit in dict.fromkeys(units.tolist()):
            chosen = units == unit
            squares.setdefault(unit, []).append((answer.mean - trial.truth)[chosen] ** 2)
    return {unit: float(np.sqrt(np.concatenate(parts).mean())) for unit, parts in squares.items()}


def _coverage(pairs: Sequence[tuple[Trial, Answer]]) -> float | None:
    inside = [
        np.abs(answer.mean - trial.truth) <= _WITHIN_95 * np.sqrt(answer.variance)
        for trial, answer in pairs
        if answer.variance is not None
    ]
    return float(np.concatenate(inside).mean()) if inside else None
