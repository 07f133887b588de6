r"""What a recording's own trials say of the variances that a model claims.

The variance of a channel is multiplied by the mean ratio, in the trials, of squared errors to
claimed variances, where that is above one. Three trials say too little to make variances as small
as they show, but none is left larger than four times what the worst of three shows, and none less
than a ten-thousandth of what is claimed. Where the model knows from other evidence how small its
variances may be, they are made as small as the worst of three shows, but no smaller than that.

Where copies of a channel's gap had to be shorter, they are easier: their entries lie nearer to
visible ones. They are then tried at half their length, too. If the ratio of such channels grows
from one to the other as a power of the distance to the nearest visible frame, it is taken to grow
so up to the distance in the gap.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.protocols import Prediction
from mocapbench.baselines.rehearsal.ratios import geometric_ratios, mean_ratios, squared_ratios
from mocapbench.baselines.rehearsal.trials import (
    Places,
    copies_or_islands,
    halved,
    remoteness,
    trial_masks,
)
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Mask, Recording

__all__ = ["STEEPEST", "VarianceCheck"]

Distances = NDArray[np.intp]

_TINY = np.finfo(np.float64).tiny
_SURE = 3
"""Trials that can show variances to be too large."""
_MARGIN = 4.0
"""How many times as large as the worst of these trials shows variances may be."""
_LEAST = 1e-4
"""The least factor of variances: where nothing varies, trials err nowhere. It is far below that of
`ratios`, which bounds a mean of trials and training: here it bounds four times the worst trial."""
STEEPEST = 0.6
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
    def of(cls, recording: Recording, places: Places = copies_or_islands) -> Self:
        """Choose the trials, which hide ``places`` for the gaps."""
        copies = trial_masks(recording, places)
        halves = [halved(~recording.visible, mask) for mask in copies]
        check = cls(recording, copies, halves)
        return check if check._short.any() else replace(check, halves=[])

    @property
    def n_trials(self) -> int:
        """The number of trials."""
        return len(self.copies) + len(self.halves)

    @property
    def can_narrow(self) -> bool:
        """Whether there are enough trials to show variances to be too large."""
        return len(self.copies) >= _SURE

    def trials(self) -> list[Recording]:
        """Return the recording as each trial shows it, the copies first."""
        return [self.recording.hide(mask) for mask in (*self.copies, *self.halves)]

    def applied(
        self,
        claimed: Prediction,
        answers: Sequence[Prediction],
        least: Prediction | None = None,
    ) -> Prediction:
        """Return a prediction with variances that the answers to the trials bear out.

        Parameters
        ----------
        claimed : Prediction
            Of the recording.
        answers : sequence of Prediction
            Of the `trials`, in their order.
        least : Prediction, optional
            The same with the least variances that other evidence bears out.
        """
        if not answers or claimed.variance is None:
            return claimed
        by_trial = self._ratios(self.copies, answers[: len(self.copies)])
        factors = self._factors(by_trial, answers)
        variance = claimed.variance * np.maximum(factors, self._least(by_trial))
        if least is not None and least.variance is not None:
            shown = claimed.variance * np.maximum(factors, self._shown(by_trial))
            variance = np.minimum(variance, np.maximum(shown, least.variance))
        return Prediction(claimed.mean, variance)

    def factors(self, answers: Sequence[Prediction]) -> Array:
        """Return by how much squared errors exceed claimed variances in the gaps: (D,).

        Parameters
        ----------
        answers : sequence of Prediction
            Of the `trials`, in their order.
        """
        return self._factors(self._ratios(self.copies, answers[: len(self.copies)]), answers)

    def _factors(self, by_trial: Array, answers: Sequence[Prediction]) -> Array:
        """Return the `factors`, given the ratios in the copies by trial (T, 2, D)."""
        sums, counts = by_trial.sum(axis=0)
        factors = mean_ratios(sums, counts)
        if self.halves:
            factors = factors * self._growth(sums, counts, answers[len(self.copies) :])
        return factors

    @property
    def steepest(self) -> Array:
        """The most by which ratios may grow from the copies to the gaps, (D,); 1 if not shorter."""
        gap, copy, _ = self._distances
        lengthened = np.divide(gap, copy, out=np.ones(len(gap)), where=(copy > 0) & (copy < gap))
        return np.asarray(lengthened**STEEPEST)

    def _least(self, by_trial: Array) -> Array:
        """Return the least that variances may be multiplied by: (D,), at most 1."""
        if not self.can_narrow:
            return np.ones(len(self.recording.channels))
        worst = _worst(by_trial, geometric_ratios)
        return np.asarray(np.clip(_MARGIN * worst * self.steepest, _LEAST, 1.0))

    def _shown(self, by_trial: Array) -> Array:
        """Return what the worst of three trials shows: (D,), 1 where copies are shorter."""
        if not self.can_narrow:
            return np.ones(len(self.recording.channels))
        return np.where(self.steepest > 1.0, 1.0, _worst(by_trial, mean_ratios))

    def _growth(self, sums: Array, counts: Array, answers: Sequence[Prediction]) -> Array:
        """Return by what the ratio grows from the copies to the gaps: (D,)."""
        short = self._short
        gap, copy, half = (distances[short] for distances in self._distances)
        halves = self._ratios(self.halves, answers).sum(axis=0)
        less, fewer = (each[short].sum() for each in halves)
        steps = (sums[short].sum() / counts[short].sum() + _TINY) / (less / fewer + _TINY)
        power = np.clip(np.log(steps) / np.log(copy / half).mean(), 0.0, STEEPEST)
        growth = np.ones(len(short))
        growth[short] = (gap / copy) ** power
        return growth

    @cached_property
    def _distances(self) -> tuple[Distances, Distances, Distances]:
        """How far from visible frames gaps, copies and halves reach in each channel: (D,) each."""
        hidden = ~self.recording.visible
        gap, copy, half = (
            np.max([remoteness(hidden | mask, mask) for mask in masks], axis=0, initial=0)
            for masks in ([hidden], self.copies, self.halves)
        )
        return gap, copy, half

    @property
    def _short(self) -> NDArray[np.bool_]:
        """The channels (D,) whose copies are shorter than gaps, and longer than halves."""
        gap, copy, half = self._distances
        return np.asarray((half > 0) & (half < copy) & (copy < gap))

    def _ratios(self, masks: Sequence[Mask], answers: Sequence[Prediction]) -> Array:
        """Return the sums of squared errors over claims, and their numbers, by trial: (T, 2, D)."""
        return np.array(
            [
                squared_ratios(self.recording, mask, answer)
                for mask, answer in zip(masks, answers, strict=True)
            ]
        )


def _worst(by_trial: Array, ratios: Callable[[Array, Array], Array]) -> Array:
    """Return the ratio of the trial in which it is largest, for each channel: (D,)."""
    return np.asarray(np.max([ratios(*one) for one in by_trial], axis=0))
