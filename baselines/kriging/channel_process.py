r"""A Gaussian process over frames of channels that are hidden together.

Frames are alike in the channels by which they are described. The covariance of frames t and t' of
recordings r and r', up to scale, is

.. math::

    \bigl(1 + \alpha\, \delta_{rr'}\bigr) \left[1 + \beta\, \phi_t^\top \phi_{t'}
    + \left(1 + \frac{\lVert \phi_t - \phi_{t'} \rVert^2}{\ell^2}\right)^{-1/2}\right]
    + \gamma\, \delta_{rr'}\, m\Bigl(\frac{|t - t'|}{\tau}\Bigr) + \varepsilon\, \delta_{tt'},

with m Matérn's once differentiable kernel: a constant, a linear and a curved function of the
description :math:`\phi` of a frame, of which all recordings share one and each has another one of
its own; a drift over time; and noise.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from sklearn.utils.extmath import row_norms

from mocapbench.baselines.gp.prior.kernels import Matern32
from mocapbench.baselines.kriging.described_frames import DescribedFrames, choose_from_both
from mocapbench.baselines.kriging.held_out_stretches import (
    HeldOutStretches,
    add_noise,
    learn_parameters,
    noise_variance,
    predict_frames,
    stretch_numbers,
)
from mocapbench.basics.arrays import Array

__all__ = [
    "TYPICAL",
    "ChannelPairs",
    "learn_channel_process",
    "predict_channels",
    "prior_variances",
]


TYPICAL: Array = np.log([1.0, 0.25, 0.3, 0.3, 8.0, 0.2])
"""Medians of the priors: of ℓ, √β, √α, √γ, τ in frames, and √ε."""
_LEARNT = 150
"""Frames of the recording to fill, and of all others, from which parameters are learnt: about."""
_ROWS = 256
"""Of a covariance, computed at once."""
_SUPPOSED = 2.0
"""Gaps that count as erring as the prior has it, beside those that are held out."""
_LEAST = 1e-12
"""Least mean square of a channel that counts."""


@dataclass(frozen=True, eq=False)
class ChannelPairs:
    """How n frames are related to m others; those of a recording stand next to each other.

    Parameters
    ----------
    distances : ndarray of shape (n, m)
        Squared, between their descriptions.
    products : ndarray of shape (n, m)
        Of their descriptions.
    together : sequence of ((rows, columns), lags)
        For each recording that both have frames of, where these are in an array (n, m), and how
        many frames apart.
    """

    distances: Array
    products: Array
    together: Sequence[tuple[tuple[slice, slice], Array]]

    @classmethod
    def of(cls, one: DescribedFrames, other: DescribedFrames) -> Self:
        """Relate frames to others."""
        products = one.description @ other.description.T
        # ‖φ − φ'‖² = ‖φ‖² + ‖φ'‖² − 2 φᵀφ': the products are by far the longest to compute.
        distances = -2.0 * products
        distances += row_norms(one.description, squared=True)[:, None]
        distances += row_norms(other.description, squared=True)
        np.maximum(distances, 0.0, out=distances)
        if one is other:
            np.fill_diagonal(distances, 0.0)
        return cls(distances, products, list(_pairs_of_recordings(one, other)))

    def covariance(self, parameters: Array) -> Array:
        """Return the covariance (n, m), noise left out; parameters are logarithms (`TYPICAL`)."""
        length, linear, own, drift, lasting, _ = np.exp(parameters)
        covariance = 1.0 + linear**2 * self.products
        covariance += 1.0 / np.sqrt(1.0 + self.distances / length**2)
        for place, lags in self.together:
            course = drift**2 * Matern32().value(lags, lasting)
            covariance[place] = (1.0 + own**2) * covariance[place] + course
        return np.asarray(covariance)

    def derivatives(self, parameters: Array) -> Sequence[Array]:
        """Return those of the covariance by the logarithms of ℓ, √β, √α, √γ and τ."""
        length, linear, own, drift, lasting, _ = np.exp(parameters)
        squares, kernel = self.distances / length**2, Matern32()
        curved = 1.0 / np.sqrt(1.0 + squares)
        shared = 1.0 + linear**2 * self.products + curved
        # ∂(1 + s)^(−1/2) / ∂ log ℓ = s (1 + s)^(−3/2), with s = ‖φ − φ'‖² / ℓ².
        by_length = squares * curved**3
        by_linear = 2.0 * linear**2 * self.products
        by_own, by_drift, by_lasting = (np.zeros_like(shared) for _ in range(3))
        for place, lags in self.together:
            for shared_by in (by_length, by_linear):
                shared_by[place] *= 1.0 + own**2
            by_own[place] = 2.0 * own**2 * shared[place]
            by_drift[place] = 2.0 * drift**2 * kernel.value(lags, lasting)
            by_lasting[place] = drift**2 * kernel.gradient(lags, lasting)
        return by_length, by_linear, by_own, by_drift, by_lasting


def prior_variances(frames: DescribedFrames, parameters: Array) -> Array:
    """Return the prior variances (n,) of frames, noise left out."""
    _, linear, own, drift, _, _ = np.exp(2.0 * parameters)
    lengths = (frames.description**2).sum(axis=1)
    return np.asarray((1.0 + own) * (2.0 + linear * lengths) + drift)


def learn_channel_process(
    frames: DescribedFrames, values: Array, spread: Array, own: int, duration: float
) -> tuple[Array, Array]:
    r"""Return the parameters that predict gaps best, and what they imply of each channel.

    Every gap that is held out counts as one frame, since its frames err together, and C
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

    Returns
    -------
    parameters : ndarray of shape (6,)
        Logarithms, in the order of `TYPICAL`.
    scales : ndarray of shape (C,)
        What the variances of each channel are multiplied by.
    """
    some = choose_from_both(frames.recording, own, _LEARNT)
    frames, values = frames.at(some), values[some]
    squares = np.maximum((values**2).mean(axis=0), _LEAST)
    values = values / np.sqrt(squares)
    stretch = stretch_numbers(frames.times, frames.recording, duration)
    n_gaps, pairs = int(stretch.max()) + 1, ChannelPairs.of(frames, frames)
    weight = n_gaps / len(stretch) / np.sqrt(values.shape[1])
    found = learn_parameters(pairs, values, stretch, TYPICAL, weight)
    ratios = squares * HeldOutStretches(add_noise(pairs, found), values, stretch).scales
    supposed = _SUPPOSED * spread / prior_variances(frames, found).mean()
    return found, np.maximum(ratios + supposed / n_gaps, _LEAST)


def predict_channels(
    frames: DescribedFrames,
    values: Array,
    wanted: DescribedFrames,
    parameters: Array,
    scales: Array,
) -> tuple[Array, Array]:
    """Return the mean and the variance (m, C) of observations in the frames wanted."""
    cross = ChannelPairs.of(wanted, frames).covariance(parameters)
    mean, explained = predict_frames(_relate_known(frames, parameters), cross, values)
    noise = np.exp(2.0 * parameters[-1])
    variance = np.maximum(prior_variances(wanted, parameters) - explained, 0.0) + noise
    return mean, np.outer(variance, scales)


def _relate_known(frames: DescribedFrames, parameters: Array) -> Array:
    """Return the covariance (n, n) of frames with themselves, noise included.

    It is computed some rows at a time, up to the diagonal, in memory that stays in the processor's
    cache. What is above that is not filled in.
    """
    n_frames = len(frames.times)
    covariance = np.empty((n_frames, n_frames))
    for first in range(0, n_frames, _ROWS):
        last = min(first + _ROWS, n_frames)
        rows, before = frames.at(slice(first, last)), frames.at(slice(last))
        covariance[first:last, :last] = ChannelPairs.of(rows, before).covariance(parameters)
    covariance[np.diag_indices(n_frames)] += noise_variance(parameters)
    return covariance


def _pairs_of_recordings(
    one: DescribedFrames, other: DescribedFrames
) -> Iterator[tuple[tuple[slice, slice], Array]]:
    for number in np.intersect1d(one.recording, other.recording):
        rows, columns = (_frames_of(number, frames) for frames in (one, other))
        lags = np.abs(np.subtract.outer(one.times[rows], other.times[columns]))
        yield (rows, columns), lags.astype(np.float64)


def _frames_of(number: int, frames: DescribedFrames) -> slice:
    places = np.flatnonzero(frames.recording == number)
    if len(places) != places[-1] + 1 - places[0]:
        raise ValueError("expected frames of a recording next to each other, got some apart")
    return slice(places[0], places[-1] + 1)
