"""Straight lines between the visible entries of each channel."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import numpy as np

from mocapbench.baselines import Imputer, Inductive, Prediction
from mocapbench.datasets import Recording

__all__ = ["StraightLines"]


class StraightLines(Imputer, Inductive):
    """Join the visible entries of each channel; beyond them, hold the nearest.

    A channel that shows nothing is filled with its mean over the recordings given to `fit`.

    Attributes
    ----------
    mean_ : ndarray of shape (D,)
        Mean of each channel's visible entries.
    """

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn the channels' means."""
        self.mean_ = np.nanmean(np.concatenate([r.values for r in recordings]), axis=0)
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return one prediction per recording, without a variance."""
        return [Prediction.around(recording, self._lines(recording)) for recording in recordings]

    def _lines(self, recording: Recording) -> np.ndarray:
        lines = np.tile(self.mean_, (len(recording.times), 1))
        for channel, seen in enumerate(recording.visible.T):
            if seen.any():
                values = recording.values[seen, channel]
                lines[:, channel] = np.interp(recording.times, recording.times[seen], values)
        return lines
