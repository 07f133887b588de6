r"""A Gaussian process of where a marker is, as seen from the markers around it.

The covariance of frames t and t' of recordings r and r', up to scale, is

.. math::

    1 + \delta_{rr'} + \Bigl(1 + \frac{\lVert \phi_t - \phi_{t'} \rVert^2}{\ell^2}\Bigr)^{-1/2}
    + \Bigl(1 + \frac{\lVert \phi_t - \phi_{t'} \rVert^2
    + w^2 \lVert \chi_t - \chi_{t'} \rVert^2}{\ell^2}\Bigr)^{-1/2}
    + \delta_{rr'}\, a^2\, m\Bigl(\frac{|t - t'|}{\tau}\Bigr) + \delta_{tt'}\, \varepsilon^2 :

a constant, another one for each recording, what follows from the shape :math:`\phi` of the markers
around, what follows from this and from its changes :math:`\chi` together, with w = 0.3, a drift
with Matérn's once differentiable kernel m, and noise. :math:`\ell, a, \tau, \varepsilon` are those
that predict gaps best, twice as long as the one to fill, that are held out of what is visible
(`held_out_stretches`). Each such gap counts as one frame, since its frames err together, and
logarithms have normal priors with standard deviation 1. The scale is inferred from G gaps, so that
predictions are Student's t with G degrees of freedom.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from mocapbench.baselines.gp.prior.kernels import Matern32
from mocapbench.baselines.kriging.conditioned import student_variance
from mocapbench.baselines.kriging.described_frames import DescribedFrames
from mocapbench.baselines.kriging.held_out_stretches import (
    HeldOutStretches,
    add_noise,
    learn_parameters,
    predict_frames,
    stretch_numbers,
)
from mocapbench.basics.arrays import Array

__all__ = ["FramePairs", "learn_marker_process", "predict_marker"]


_TYPICAL: Array = np.log([2.0, 0.3, 0.25, 0.05])
"""Medians of the priors: ℓ where shapes and changes have variance 1, a, τ in seconds, and ε."""
_CHANGES = 0.3
"""w. A variance of what follows from changes that is learnt grows without end in long gaps."""
_CONSTANTS, _SHAPES = 2.0, 2.0
"""The variances of both constants, and of both parts that follow from shapes."""
_LEAST_SCALE = 1e-6


@dataclass(frozen=True, eq=False)
class FramePairs:
    """How n frames are related to m others.

    Parameters
    ----------
    distances, changes : ndarray of shape (n, m)
        Squared distances between their shapes, and between the changes of these.
    lags : ndarray of shape (n, m)
        In seconds.
    together : ndarray of bool, shape (n, m)
        Whether both are of one recording.
    """

    distances: Array
    changes: Array
    lags: Array
    together: NDArray[np.bool_]

    @classmethod
    def of(cls, one: DescribedFrames, other: DescribedFrames) -> Self:
        """Relate frames to others; descriptions (n, 1 + L, F) are shapes and L changes of each."""
        return cls(
            cdist(one.description[:, 0], other.description[:, 0], "sqeuclidean"),
            cdist(_list_changes(one), _list_changes(other), "sqeuclidean"),
            np.abs(np.subtract.outer(one.times, other.times)),
            np.equal.outer(one.recording, other.recording),
        )

    def covariance(self, parameters: Array) -> Array:
        """Return the covariance (n, m), noise left out, given the logarithms of ℓ, a, τ and ε."""
        length, drift, duration, _ = np.exp(parameters)
        shape, changing = (1.0 / np.sqrt(1.0 + squares) for squares in self._squares(length))
        course = drift**2 * Matern32().value(self.lags, duration)
        return np.asarray(1.0 + shape + changing + self.together * (1.0 + course))

    def derivatives(self, parameters: Array) -> list[Array]:
        """Return those of the covariance by the logarithms of ℓ, a and τ."""
        length, drift, duration, _ = np.exp(parameters)
        shape, changing = self._squares(length)
        kernel = Matern32()
        # ∂(1 + s)^(−1/2) / ∂ log ℓ = s (1 + s)^(−3/2), where s is in proportion to ℓ⁻².
        return [
            shape * (1.0 + shape) ** -1.5 + changing * (1.0 + changing) ** -1.5,
            self.together * 2.0 * drift**2 * kernel.value(self.lags, duration),
            self.together * drift**2 * kernel.gradient(self.lags, duration),
        ]

    def _squares(self, length: float) -> tuple[Array, Array]:
        """Return squared distances over ℓ² of shapes, and of shapes and changes together."""
        shape = self.distances / length**2
        return shape, shape + _CHANGES**2 * self.changes / length**2


def _list_changes(frames: DescribedFrames) -> Array:
    return frames.description[:, 1:].reshape(len(frames.times), -1)


def learn_marker_process(
    frames: DescribedFrames, values: Array, seconds: float
) -> tuple[Array, float]:
    """Return the parameters that predict gaps best, and what variances are multiplied by.

    Parameters
    ----------
    frames : DescribedFrames
        In which the marker is visible, by the shape of the markers around; times in seconds.
    values : ndarray of shape (n, 3)
        Where it is, with mean zero and variance 1.
    seconds : float
        How long the gaps are.

    Returns
    -------
    parameters : ndarray of shape (4,)
        Logarithms of ℓ, a, τ and ε.
    scale : float
    """
    pairs = FramePairs.of(frames, frames)
    stretch = stretch_numbers(frames.times, frames.recording, seconds)
    n_gaps = int(stretch.max()) + 1
    found = learn_parameters(pairs, values, stretch, _TYPICAL, n_gaps / len(stretch))
    scale = max(HeldOutStretches(add_noise(pairs, found), values, stretch).scale, _LEAST_SCALE)
    return found, scale * student_variance(n_gaps)


def predict_marker(
    frames: DescribedFrames, values: Array, wanted: DescribedFrames, parameters: Array, scale: float
) -> tuple[Array, Array]:
    """Return the mean (m, 3) and the variance (m,) of an observation in the frames wanted."""
    known, across = FramePairs.of(frames, frames), FramePairs.of(wanted, frames)
    covariance, cross = add_noise(known, parameters), across.covariance(parameters)
    mean, explained = predict_frames(covariance, cross, values)
    _, drift, _, noise = np.exp(2.0 * parameters)
    # K(t, t): the constants, both parts of shapes, a² for the drift, and ε².
    total = _CONSTANTS + _SHAPES + drift + noise
    return mean, scale * np.maximum(total - explained, noise)
