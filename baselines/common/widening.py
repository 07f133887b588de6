"""Variances that a recording's own trials have checked.

A model may claim too much of a recording that is unlike its training, such as the walk of a
stranger. Trials hide more of the recording where the truth is visible. The variances of the gaps
are multiplied by the ratio of squared errors to claimed variances in the trials. Means stay as
they are, and no variance becomes smaller.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.trials import trial_masks
from mocapbench.baselines.protocols import Prediction
from mocapbench.datasets import Mask, Recording

__all__ = ["Impute", "Widened", "widened"]

Array = NDArray[np.float64]
Impute = Callable[[Sequence[Recording]], list[Prediction]]

_PRIOR_ENTRIES = 10
"""Trial entries that count in each channel as having the mean ratio over all channels."""


class Widened(ABC):
    """A model whose variances `widened` checks when it fills recordings."""

    @abstractmethod
    def as_claimed(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictions of `impute`, with the variances that the model itself claims."""


def widened(recordings: Sequence[Recording], impute: Impute) -> list[Prediction]:
    """Return the predictions of recordings with variances that their trials bear out.

    Parameters
    ----------
    recordings : sequence of Recording
    impute : callable
        From recordings to one prediction each, with a variance. What it predicts of one may not
        depend on the others.
    """
    masks = [trial_masks(recording) for recording in recordings]
    trials = [
        recording.hide(mask)
        for recording, own in zip(recordings, masks, strict=True)
        for mask in own
    ]
    predictions = iter(impute([*recordings, *trials]))
    filled = [next(predictions) for _ in recordings]
    tried = [[next(predictions) for _ in own] for own in masks]
    return [
        _widened(recording, prediction, list(zip(own, answers, strict=True)))
        for recording, prediction, own, answers in zip(
            recordings, filled, masks, tried, strict=True
        )
    ]


def _widened(
    recording: Recording, prediction: Prediction, trials: Sequence[tuple[Mask, Prediction]]
) -> Prediction:
    if not trials or prediction.variance is None:
        return prediction
    sums, counts = np.sum([_ratios(recording, *trial) for trial in trials], axis=0)
    overall = sums.sum() / counts.sum()
    factors = (sums + _PRIOR_ENTRIES * overall) / (counts + _PRIOR_ENTRIES)
    return Prediction(prediction.mean, prediction.variance * np.maximum(factors, 1.0))


def _ratios(recording: Recording, mask: Mask, answer: Prediction) -> tuple[Array, Array]:
    """Return the sum of squared errors over claimed variances, and their number, by channel."""
    claimed = np.where(mask, np.asarray(answer.variance, dtype=np.float64), 1.0)
    squares = np.where(mask, (recording.values - answer.mean) ** 2 / claimed, 0.0)
    return squares.sum(axis=0), mask.sum(axis=0)
