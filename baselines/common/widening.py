"""Variances that a recording's own trials have checked.

A model may claim too much of a recording that is unlike its training, such as the walk of a
stranger. Trials hide more of the recording where the truth is visible. The variances of the gaps
are multiplied by the ratio of squared errors to claimed variances in the trials. Means stay as
they are, and no variance becomes smaller.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from sklearn.base import clone

from mocapbench.baselines.common.recordings import pool
from mocapbench.baselines.common.trials import copies_or_islands, trial_masks
from mocapbench.baselines.protocols import Model, Prediction
from mocapbench.datasets import Mask, Recording

__all__ = ["Relearning", "Widened", "widened"]

Array = NDArray[np.float64]

_PRIOR_ENTRIES = 10
"""Trial entries that count in each channel as having the mean ratio over all channels."""


class Widened(Model):
    """A model whose variances `widened` checks when it fills recordings."""

    @abstractmethod
    def as_claimed(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictions of `impute`, with the variances that the model itself claims."""

    def as_tried(self, trials: Sequence[Recording]) -> list[Prediction]:
        """Return what it claims of recordings of which more is hidden."""
        return self.as_claimed(trials)


class Relearning(Widened):
    """A model that learns anew for the trials of a recording from which it has learnt.

    Otherwise its parameters would have seen what a trial hides, and it would err less in trials
    than in gaps.
    """

    learnt_from_: Sequence[Recording]
    """The recordings given to ``fit``, which sets them."""

    def as_tried(self, trials: Sequence[Recording]) -> list[Prediction]:
        """Return what it claims of recordings of which more is hidden, not having seen that."""
        known = {recording.name for recording in self.learnt_from_}
        strangers = [trial for trial in trials if trial.name not in known]
        answers = iter(self.as_claimed(strangers) if strangers else ())
        return [self._anew(trial) if trial.name in known else next(answers) for trial in trials]

    def _anew(self, trial: Recording) -> Prediction:
        relearnt: Relearning = clone(self)
        relearnt.fit(pool(self.learnt_from_, [trial]))
        return relearnt.as_claimed([trial])[0]


def widened(model: Widened, recordings: Sequence[Recording]) -> list[Prediction]:
    """Return a model's predictions of recordings, with variances that their trials bear out.

    Parameters
    ----------
    model : Widened
        What it claims of one recording may not depend on the others.
    recordings : sequence of Recording
    """
    masks = [trial_masks(recording, copies_or_islands) for recording in recordings]
    trials = [
        recording.hide(mask)
        for recording, own in zip(recordings, masks, strict=True)
        for mask in own
    ]
    answers = iter(model.as_tried(trials) if trials else ())
    return [
        _widened(recording, claimed, [(mask, next(answers)) for mask in own])
        for recording, claimed, own in zip(
            recordings, model.as_claimed(recordings), masks, strict=True
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
