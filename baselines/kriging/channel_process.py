"""A Gaussian process over frames of channels that are hidden together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from mocapbench.baselines.kriging.channel_pairs import TYPICAL, ChannelPairs, DescribedFrames
from mocapbench.baselines.kriging.learning import (
    best_predicting,
    noisy,
    predict_frames,
    some_of_both,
    stretch_numbers,
)
from mocapbench.baselines.kriging.left_out_gaps import LeftOutGaps
from mocapbench.basics.arrays import Array

__all__ = ["ChannelProcess"]


_LEARNT = 150
"""Frames of the recording to fill, and of all others, from which parameters are learnt."""
_SUPPOSED = 2.0
"""Gaps that count as erring as the prior has it, beside those that are left out."""
_LEAST = 1e-12
"""Least mean square of a channel that counts."""


@dataclass(frozen=True, eq=False)
class ChannelProcess:
    """A process with its parameters.

    Parameters
    ----------
    parameters : ndarray of shape (6,)
        Logarithms, in the order of `TYPICAL`.
    scales : ndarray of shape (C,)
        What the variances of each channel are multiplied by.
    """

    parameters: Array
    scales: Array

    @classmethod
    def learnt(
        cls, frames: DescribedFrames, values: Array, spread: Array, own: int, duration: float
    ) -> Self:
        r"""Return the process that predicts gaps best.

        Every gap that is left out counts as one frame, since its frames err together, and C
        channels as √C, since some of them err together. The mean ratio :math:`\rho_d` of squared
        errors to variances in G gaps tells the scale of channel d, with an inverse gamma prior by
        which its variance is :math:`s_d^2`: if v is the mean prior variance without a scale, it is
        :math:`\rho_d + 2 s_d^2 / (G v)`.

        Parameters
        ----------
        frames : DescribedFrames
            In which the channels are visible.
        values : ndarray of shape (n, C)
            Of these channels.
        spread : ndarray of shape (C,)
            The mean squares s² of the channels over all recordings.
        own : int
            The number of the recording to fill.
        duration : float
            How many frames its gaps last.
        """
        some = some_of_both(frames.recording == own, _LEARNT)
        frames, values = frames.at(some), values[some]
        squares = np.maximum((values**2).mean(axis=0), _LEAST)
        values = values / np.sqrt(squares)
        stretch = stretch_numbers(frames.place, frames.recording, duration)
        n_gaps, pairs = int(stretch.max()) + 1, ChannelPairs.of(frames, frames)
        weight = n_gaps / len(stretch) / np.sqrt(values.shape[1])
        found = best_predicting(pairs, values, stretch, TYPICAL, weight)
        ratios = squares * LeftOutGaps(noisy(pairs, found), values, stretch).scales
        supposed = _SUPPOSED * spread / frames.variances(found).mean()
        return cls(found, np.maximum(ratios + supposed / n_gaps, _LEAST))

    def predict(
        self, frames: DescribedFrames, values: Array, wanted: DescribedFrames
    ) -> tuple[Array, Array]:
        """Return the mean and the variance (m, C) of observations in the frames wanted."""
        known, across = ChannelPairs.of(frames, frames), ChannelPairs.of(wanted, frames)
        mean, explained = predict_frames(known, across, self.parameters, values)
        noise = np.exp(2.0 * self.parameters[-1])
        variance = np.maximum(wanted.variances(self.parameters) - explained, 0.0) + noise
        return mean, np.outer(variance, self.scales)
