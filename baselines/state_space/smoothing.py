r"""The smoother of Rauch, Tung and Striebel: the states given all frames.

With the gain :math:`G_t = P_t A^\top P_{t+1|t}^{-1}`, mean and covariance of a state follow from
those of the next: :math:`\hat x_t = x_t + G_t(\hat x_{t+1} - A x_t)` and :math:`\hat P_t = P_t +
G_t(\hat P_{t+1} - P_{t+1|t})G_t^\top`.

H. E. Rauch, F. Tung and C. T. Striebel (1965), *Maximum Likelihood Estimates of Linear Dynamic
Systems*, AIAA Journal 3(8).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.state_space.filtering import Filtered, filter_states, recurrence
from mocapbench.baselines.state_space.model import StateSpaceParameters
from mocapbench.baselines.state_space.observations import Observations
from mocapbench.baselines.state_space.regression import transpose_each
from mocapbench.basics.arrays import Array

__all__ = ["Smoothed", "smooth_states"]


@dataclass(frozen=True, eq=False)
class Smoothed:
    """The posterior of the states of all sequences; without meaning at the padding.

    Parameters
    ----------
    mean : ndarray of shape (K, N, q)
        Mean of each state.
    covariance : ndarray of shape (K, N, q, q)
        Covariance of each state.
    lagged : ndarray of shape (K, N - 1, q, q)
        Covariance of each state but the first (rows) with the one before (columns).
    log_likelihood : ndarray of shape (K,)
        Log-density of the visible entries of each sequence.
    """

    mean: Array
    covariance: Array
    lagged: Array
    log_likelihood: Array


def smooth_states(parameters: StateSpaceParameters, data: Observations) -> Smoothed:
    """Return the posterior of the states of all sequences."""
    forward = filter_states(parameters, data)
    gains = _gains(parameters, forward, data)
    mean = forward.mean
    shifts = mean - _product(gains, mean @ parameters.dynamics.coefficients.T)
    mean = recurrence(_latest_first(gains), _latest_first(shifts))[::-1].swapaxes(0, 1)
    covariance = _covariances(gains, forward, data)
    lagged = covariance[:, 1:] @ transpose_each(gains[:, :-1])
    return Smoothed(mean, covariance, lagged, forward.log_likelihood)


def _gains(parameters: StateSpaceParameters, forward: Filtered, data: Observations) -> Array:
    """Return the gains (K, N, q, q), 0 where a sequence has no next frame."""
    ahead = parameters.dynamics.coefficients @ forward.covariance[:, :-1]
    gains = np.zeros_like(forward.covariance)
    gains[:, :-1] = transpose_each(np.linalg.solve(forward.predicted[:, 1:], ahead))
    has_next = np.arange(gains.shape[1]) < data.lengths[:, None] - 1
    return np.where(has_next[..., None, None], gains[data.groups], 0.0)


def _covariances(gains: Array, forward: Filtered, data: Observations) -> Array:
    """Return the smoothed covariances (K, N, q, q), from the last frame to the first."""
    own = forward.covariance[data.groups]
    ahead = forward.predicted[data.groups, 1:]
    own[:, :-1] -= gains[:, :-1] @ ahead @ transpose_each(gains[:, :-1])
    covariance = np.empty_like(own)
    covariance[:, -1] = current = own[:, -1]
    for t in reversed(range(own.shape[1] - 1)):
        current = own[:, t] + gains[:, t] @ current @ transpose_each(gains[:, t])
        covariance[:, t] = current
    return covariance


def _latest_first(array: Array) -> Array:
    """Return (K, N, …) as (N, K, …) with the last frame first."""
    return array.swapaxes(0, 1)[::-1]


def _product(matrices: Array, vectors: Array) -> Array:
    return np.asarray((matrices @ vectors[..., None])[..., 0])
