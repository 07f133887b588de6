r"""What a recording's own trials say of the variances that a model claims.

The variance of a channel is multiplied by the mean ratio, in the trials, of squared errors to
claimed variances, where that is above one.

Where copies of a gap had to be shorter, they are easier: their entries lie nearer to visible ones.
They are then tried at half their length, too. If the ratio grows from one to the other as a power
of the distance to the nearest visible frame, it is taken to grow so up to the distance in the gap.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.trials import (
    copies_or_islands,
    halved,
    remoteness,
    trial_masks,
)
from mocapbench.baselines.protocols import Prediction
from mocapbench.datasets import Mask, Recording

__all__ = ["VarianceCheck"]

Array = NDArray[np.float64]

_TINY = np.finfo(np.float64).tiny
_PRIOR_ENTRIES = 10
"""Trial entries that count in each channel as having the mean ratio over all channels."""
_STEEPEST = 0.6
"""Largest power of the distance by which ratios grow: what two short lengths say is noisy.
``docs/calibration.md`` has the choice."""


@dataclass(frozen=True, eq=False)
class VarianceCheck:
    """The trials of a recording.

    Parameters
    ----------
    recording : Recording
    copies : sequence of Mask
        What each trial hides besides the gaps.
    halves : sequence of Mask
        The same, half as long; empty where copies are as long as the gaps, or too short for it.
    """

    recording: Recording
    copies: Sequence[Mask]
    halves: Sequence[Mask]

    @classmethod
    def of(cls, recording: Recording) -> Self:
        """Choose the trials."""
        hidden = ~recording.visible
        copies = trial_masks(recording, copies_or_islands)
        halves = [halved(hidden, mask) for mask in copies]
        distances = [_distance(hidden, masks) for masks in (halves, copies, [hidden])]
        nearer = distances == sorted(set(distances))
        return cls(recording, copies, halves if nearer else [])

    @property
    def trials(self) -> list[Recording]:
        """The recording as each trial shows it, the copies first."""
        return [self.recording.hide(mask) for mask in (*self.copies, *self.halves)]

    def applied(self, claimed: Prediction, answers: Sequence[Prediction]) -> Prediction:
        """Return a prediction with variances that the answers to the trials bear out.

        Parameters
        ----------
        claimed : Prediction
            Of the recording.
        answers : sequence of Prediction
            Of the `trials`, in their order.
        """
        if not answers or claimed.variance is None:
            return claimed
        n_copies = len(self.copies)
        sums, counts = self._ratios(self.copies, answers[:n_copies])
        overall = sums.sum() / counts.sum()
        factors = (sums + _PRIOR_ENTRIES * overall) / (counts + _PRIOR_ENTRIES)
        if self.halves:
            factors *= self._growth(overall, answers[n_copies:])
        return Prediction(claimed.mean, claimed.variance * np.maximum(factors, 1.0))

    def _growth(self, overall: float, answers: Sequence[Prediction]) -> float:
        """Return by what the ratio grows from the copies to the gaps."""
        hidden = ~self.recording.visible
        sums, counts = self._ratios(self.halves, answers)
        of_halves = sums.sum() / counts.sum()
        half, copy = _distance(hidden, self.halves), _distance(hidden, self.copies)
        power = np.log((overall + _TINY) / (of_halves + _TINY)) / np.log(copy / half)
        return float((_distance(hidden, [hidden]) / copy) ** np.clip(power, 0.0, _STEEPEST))

    def _ratios(self, masks: Sequence[Mask], answers: Sequence[Prediction]) -> tuple[Array, Array]:
        """Return the sum of squared errors over claimed variances, and their number, by channel."""
        sums, counts = np.zeros((2, self.recording.values.shape[1]))
        for mask, answer in zip(masks, answers, strict=True):
            claimed = np.where(mask, np.asarray(answer.variance, dtype=np.float64), 1.0)
            errors = np.where(mask, self.recording.values - answer.mean, 0.0)
            sums, counts = sums + (errors**2 / claimed).sum(axis=0), counts + mask.sum(axis=0)
        return sums, counts


def _distance(hidden: Mask, masks: Sequence[Mask]) -> int:
    """Return how far from visible frames the trials hide an entry at most."""
    return max((remoteness(hidden | mask, mask) for mask in masks), default=0)
