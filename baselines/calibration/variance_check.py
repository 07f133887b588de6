r"""What the held-out gaps of a recording say of the variances that a model predicts.

The variance of a channel is multiplied by the mean error ratio in the held-out gaps, where that is
above one. Three sets say too little to make variances as small as they show, but none is left
larger than four times what the worst of three shows, and none less than a ten-thousandth of what is
predicted. Where the model knows from other evidence how small its variances may be, they are made
as small as the worst of three shows, but no smaller than that.

Where copies of a channel's gap had to be shorter, they are easier: their entries lie nearer to
visible ones. They are then held out at half their length, too. If the ratio of such channels grows
from one to the other as a power of the distance to the nearest visible frame, it is taken to grow
so up to the distance in the gap.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.calibration.error_ratios import (
    geometric_ratios,
    mean_ratios,
    sum_ratios,
)
from mocapbench.baselines.calibration.held_out_gaps import (
    Alternatives,
    copies_or_islands,
    halve_gaps,
    hold_out_gaps,
    remoteness,
)
from mocapbench.baselines.protocols import Prediction
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Mask, Recording

__all__ = ["STEEPEST", "VarianceCheck"]

Distances = NDArray[np.intp]

_TINY = np.finfo(np.float64).tiny
_SURE = 3
"""Sets of held-out gaps that can show variances to be too large."""
_MARGIN = 4.0
"""How many times as large as the worst of these sets shows variances may be."""
_LEAST = 1e-4
"""The least factor of variances: where nothing varies, errors are 0. It is far below that of
`error_ratios`, which bounds a mean: here it bounds four times the worst set."""
STEEPEST = 0.6
"""Largest power of the distance by which ratios grow: what two short lengths say is noisy.
Chosen on recordings that are learnt from."""


class VarianceCheck:
    """The held-out gaps of a recording, and the factors of variances that they show.

    Parameters
    ----------
    recording : Recording
    alternatives : callable
        What may be held out for a gap.

    Attributes
    ----------
    copies : list of Mask
        What each set hides besides the gaps.
    halves : list of Mask
        The same, half as long; empty where copies are as long as the gaps, or too short for it.
    """

    def __init__(
        self, recording: Recording, alternatives: Alternatives = copies_or_islands
    ) -> None:
        self.recording = recording
        self.copies: list[Mask] = hold_out_gaps(recording, alternatives)
        self.halves: list[Mask] = [halve_gaps(~recording.visible, mask) for mask in self.copies]
        if not self._short.any():
            self.halves = []

    @property
    def can_narrow(self) -> bool:
        """Whether there are enough sets to show variances to be too large."""
        return len(self.copies) >= _SURE

    def recordings(self) -> list[Recording]:
        """Return the recording without each set of held-out gaps, the copies first."""
        return [self.recording.hide(mask) for mask in (*self.copies, *self.halves)]

    def calibrate(
        self,
        nominal: Prediction,
        held_out: Sequence[Prediction],
        least: Array | None = None,
    ) -> Prediction:
        """Return a prediction with the variances that errors in held-out gaps support.

        Parameters
        ----------
        nominal : Prediction
            Of the recording.
        held_out : sequence of Prediction
            Of the `recordings`, in their order.
        least : ndarray of shape (N, D), optional
            The least variances that other evidence supports.
        """
        if not held_out:
            return nominal
        by_set = self._sum_by_set(held_out[: len(self.copies)])
        if not by_set[:, 1].any():  # the model predicted no variances there
            return nominal
        factors = self._factors(by_set, held_out[len(self.copies) :])
        predicted = np.asarray(nominal.variance)
        variance = predicted * np.maximum(factors, self._least(by_set))
        if least is not None:
            shown = predicted * np.maximum(factors, self._shown(by_set))
            variance = np.minimum(variance, np.maximum(shown, least))
        return Prediction(nominal.mean, variance)

    def factors(self, held_out: Sequence[Prediction]) -> Array:
        """Return by how much squared errors exceed predicted variances in the gaps: (D,).

        Parameters
        ----------
        held_out : sequence of Prediction
            Of the `recordings`, in their order.
        """
        copies, halves = held_out[: len(self.copies)], held_out[len(self.copies) :]
        return self._factors(self._sum_by_set(copies), halves)

    def copy_factors(self, held_out: Sequence[Prediction]) -> Array:
        """Return by how much squared errors exceed predicted variances in the copies: (D,)."""
        return mean_ratios(*self._sum_by_set(held_out[: len(self.copies)]).sum(axis=0))

    def _factors(self, by_set: Array, halves: Sequence[Prediction]) -> Array:
        """Return the `factors`, given the ratios in the copies by set (T, 2, D)."""
        sums, counts = by_set.sum(axis=0)
        factors = mean_ratios(sums, counts)
        return factors * self._growth(sums, counts, halves) if self.halves else factors

    @property
    def steepest(self) -> Array:
        """The most by which ratios may grow from the copies to the gaps, (D,); 1 if not shorter."""
        gap, copy, _ = self._distances
        lengthened = np.divide(gap, copy, out=np.ones(len(gap)), where=(copy > 0) & (copy < gap))
        return np.asarray(lengthened**STEEPEST)

    def _least(self, by_set: Array) -> Array:
        """Return the least that variances may be multiplied by: (D,), at most 1."""
        if not self.can_narrow:
            return np.ones(len(self.recording.channels))
        worst = _find_worst(by_set, geometric_ratios)
        return np.asarray(np.clip(_MARGIN * worst * self.steepest, _LEAST, 1.0))

    def _shown(self, by_set: Array) -> Array:
        """Return what the worst of three sets shows: (D,), 1 where copies are shorter."""
        if not self.can_narrow:
            return np.ones(len(self.recording.channels))
        return np.where(self.steepest > 1.0, 1.0, _find_worst(by_set, mean_ratios))

    def _growth(self, sums: Array, counts: Array, halves: Sequence[Prediction]) -> Array:
        """Return by what the ratio grows from the copies to the gaps: (D,)."""
        short = self._short
        gap, copy, half = (distances[short] for distances in self._distances)
        pairs = zip(self.halves, halves, strict=True)
        in_halves = np.array([sum_ratios(self.recording, *pair) for pair in pairs]).sum(axis=0)
        less, fewer = (each[short].sum() for each in in_halves)
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

    def _sum_by_set(self, predictions: Sequence[Prediction]) -> Array:
        """Return the sums of error ratios in the copies, and their numbers, by set: (T, 2, D)."""
        pairs = zip(self.copies, predictions, strict=True)
        return np.array([sum_ratios(self.recording, *pair) for pair in pairs])


def _find_worst(by_set: Array, ratios: Callable[[Array, Array], Array]) -> Array:
    """Return the ratio of the set in which it is largest, for each channel: (D,)."""
    return np.asarray(np.max([ratios(*one) for one in by_set], axis=0))
