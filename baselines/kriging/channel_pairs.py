r"""How alike two frames are in the channels by which they are described.

The covariance of frames t and t' of recordings r and r', up to scale, is

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
from sklearn.metrics.pairwise import euclidean_distances

from mocapbench.baselines.gp.prior.kernels import Matern32
from mocapbench.basics.arrays import Array, Index

__all__ = ["TYPICAL", "ChannelPairs", "DescribedFrames"]


TYPICAL: Array = np.log([1.0, 0.25, 0.3, 0.3, 8.0, 0.2])
"""Medians of the priors: of ℓ, √β, √α, √γ, τ in frames, and √ε."""


@dataclass(frozen=True, eq=False)
class DescribedFrames:
    """The frames of several recordings, those of one recording next to each other.

    Parameters
    ----------
    description : ndarray of shape (n, F)
        φ, with a mean square of 1, summed over F; zero where nothing describes frames.
    place : ndarray of int, shape (n,)
        The number of each frame in its recording.
    recording : ndarray of int, shape (n,)
        The number of its recording.
    """

    description: Array
    place: Index
    recording: Index

    def at(self, which: Index) -> DescribedFrames:
        """Return some of the frames."""
        return DescribedFrames(self.description[which], self.place[which], self.recording[which])

    def variances(self, parameters: Array) -> Array:
        """Return the prior variances (n,), noise left out."""
        _, linear, own, drift, _, _ = np.exp(2.0 * parameters)
        lengths = (self.description**2).sum(axis=1)
        return np.asarray((1.0 + own) * (2.0 + linear * lengths) + drift)


@dataclass(frozen=True, eq=False)
class ChannelPairs:
    """How n frames are related to m others.

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
        return cls(
            euclidean_distances(one.description, other.description, squared=True),
            one.description @ other.description.T,
            list(_together(one, other)),
        )

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


def _together(
    one: DescribedFrames, other: DescribedFrames
) -> Iterator[tuple[tuple[slice, slice], Array]]:
    for number in np.intersect1d(one.recording, other.recording):
        rows, columns = (_frames_of(number, frames) for frames in (one, other))
        lags = np.abs(np.subtract.outer(one.place[rows], other.place[columns]))
        yield (rows, columns), lags.astype(np.float64)


def _frames_of(number: int, frames: DescribedFrames) -> slice:
    places = np.flatnonzero(frames.recording == number)
    if len(places) != places[-1] + 1 - places[0]:
        raise ValueError("expected frames of a recording next to each other, got some apart")
    return slice(places[0], places[-1] + 1)
