r"""The Kalman filter and the smoother of Rauch, Tung and Striebel, for partly visible frames.

A frame tells about its state by the information :math:`J_t = C^\top R^{-1} C` and :math:`h_t =
C^\top R^{-1}(y_t - d)` over its visible channels, so that all matrices are q × q however many
channels there are. Covariances are computed once for each group of sequences with the same mask
(`Sequences.groups`). The means then follow a linear recurrence, one matrix–vector product a frame.

With the gain :math:`G_t = P_t A^\top P_{t+1|t}^{-1}`, mean and covariance of a state given all
frames follow from those of the next: :math:`\hat x_t = x_t + G_t(\hat x_{t+1} - A x_t)` and
:math:`\hat P_t = P_t + G_t(\hat P_{t+1} - P_{t+1|t})G_t^\top`.

R. H. Shumway and D. S. Stoffer (1982), *An Approach to Time Series Smoothing and Forecasting Using
the EM Algorithm*, Journal of Time Series Analysis 3(4). H. E. Rauch, F. Tung and C. T. Striebel
(1965), *Maximum Likelihood Estimates of Linear Dynamic Systems*, AIAA Journal 3(8).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.state_space.linear_gaussian import StateSpaceParameters, transpose_each
from mocapbench.basics.arrays import Array

__all__ = ["Smoothed", "filter_states", "run_recurrence", "smooth_states"]


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


def filter_states(
    parameters: StateSpaceParameters, data: Sequences
) -> tuple[Array, Array, Array, Array]:
    """Return the distributions of the states of all sequences given the frames so far.

    Returns
    -------
    mean : ndarray of shape (K, N, q)
        Mean of each state given its frame and those before.
    covariance, predicted : ndarray of shape (U, N, q, q)
        Covariance by group of sequences, with and without the state's own frame.
    log_likelihood : ndarray of shape (K,)
        Log-density of the visible entries of each sequence.
    """
    # J and h of every frame.
    weights = data.visible / parameters.noise
    centred = data.visible * (data.values - parameters.offset)
    q = parameters.n_states
    information = (weights[data.leaders] @ parameters.squares).reshape(len(data.leaders), -1, q, q)
    score = (weights * centred) @ parameters.loadings
    predicted, covariance = _filter_covariances(parameters, information)
    mean, before = _filter_means(parameters, data, information, covariance, score)
    # With e = y − d − C x and g = Cᵀ R⁻¹ e = h − J x, the residual's covariance S obeys
    # log|S| = log|R| + log|I + P J| and eᵀ S⁻¹ e = eᵀ R⁻¹ e − gᵀ P' g.
    expected = (information[data.groups] @ before[..., None])[..., 0]
    innovation = score - expected
    row, column = innovation[..., None, :], innovation[..., None]
    explained = (row @ covariance[data.groups] @ column)[..., 0, 0]
    squares = (weights * centred**2).sum(axis=2) + (before * (expected - 2.0 * score)).sum(axis=2)
    log_determinant = np.linalg.slogdet(np.eye(q) + predicted @ information)[1][data.groups]
    log_determinant = log_determinant + data.visible @ np.log(2.0 * np.pi * parameters.noise)
    terms = -0.5 * (squares - explained + log_determinant)
    return mean, covariance, predicted, np.where(data.frames, terms, 0.0).sum(axis=1)


def smooth_states(parameters: StateSpaceParameters, data: Sequences) -> Smoothed:
    """Return the posterior of the states of all sequences."""
    filtered, own, predicted, log_likelihood = filter_states(parameters, data)
    gains = _smoother_gains(parameters, own, predicted, data)
    # x̂_t = G_t x̂_{t+1} + (x_t − G_t A x_t), from the last frame to the first.
    shifts = filtered - _multiply_each(gains, filtered @ parameters.transition.T)
    mean = run_recurrence(_latest_first(gains), _latest_first(shifts))[::-1].swapaxes(0, 1)
    covariance = _smooth_covariances(gains, own[data.groups], predicted[data.groups, 1:])
    lagged = covariance[:, 1:] @ transpose_each(gains[:, :-1])
    return Smoothed(mean, covariance, lagged, log_likelihood)


def run_recurrence(gains: Array, shifts: Array) -> Array:
    """Return z_t = G_t z_{t−1} + b_t from z_{−1} = 0: gains (N, K, q, q), shifts (N, K, q)."""
    states = np.empty_like(shifts)
    state = np.zeros_like(shifts[0])
    for t, (gain, shift) in enumerate(zip(gains, shifts, strict=True)):
        state = (gain @ state[..., None])[..., 0] + shift
        states[t] = state
    return states


def _filter_covariances(
    parameters: StateSpaceParameters, information: Array
) -> tuple[Array, Array]:
    """Return the covariances (U, N, q, q) of the predicted and of the filtered states."""
    transition, noise = parameters.transition, parameters.transition_covariance
    predicted, covariance = np.empty_like(information), np.empty_like(information)
    identity = np.eye(parameters.n_states)
    current = np.broadcast_to(parameters.first_covariance, information[:, 0].shape)
    for t in range(information.shape[1]):
        predicted[:, t] = current
        # (P⁻¹ + J)⁻¹ = (I + P J)⁻¹ P, which needs no inverse of P.
        updated = np.linalg.solve(identity + current @ information[:, t], current)
        covariance[:, t] = 0.5 * (updated + transpose_each(updated))
        current = transition @ covariance[:, t] @ transition.T + noise
    return predicted, covariance


def _filter_means(
    parameters: StateSpaceParameters,
    data: Sequences,
    information: Array,
    covariance: Array,
    score: Array,
) -> tuple[Array, Array]:
    """Return the means (K, N, q) of the filtered and of the predicted states.

    x_t = (I − P_t J_t) A x_{t−1} + P_t h_t.
    """
    transition = parameters.transition
    # I − P J, the gains (I − P J) A and the shifts P h.
    kept = np.eye(parameters.n_states) - covariance @ information
    gains = (kept @ transition)[data.groups]
    shifts = (covariance[data.groups] @ score[..., None])[..., 0]
    first = parameters.first[:, 0]
    shifts[:, 0] += (kept[:, 0] @ first)[data.groups]
    mean = run_recurrence(gains.swapaxes(0, 1), shifts.swapaxes(0, 1)).swapaxes(0, 1)
    before = np.empty_like(mean)
    before[:, 0] = first
    before[:, 1:] = mean[:, :-1] @ transition.T
    return mean, before


def _smoother_gains(
    parameters: StateSpaceParameters, own: Array, predicted: Array, data: Sequences
) -> Array:
    """Return the gains (K, N, q, q), 0 where a sequence has no next frame."""
    ahead = parameters.transition @ own[:, :-1]
    gains = np.zeros_like(own)
    gains[:, :-1] = transpose_each(np.linalg.solve(predicted[:, 1:], ahead))
    has_next = np.arange(gains.shape[1]) < data.lengths[:, None] - 1
    return np.where(has_next[..., None, None], gains[data.groups], 0.0)


def _smooth_covariances(gains: Array, own: Array, ahead: Array) -> Array:
    """Return the smoothed covariances (K, N, q, q), from the last frame to the first."""
    # P̂_t = (P_t − G_t P_{t+1|t} G_tᵀ) + G_t P̂_{t+1} G_tᵀ
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


def _multiply_each(matrices: Array, vectors: Array) -> Array:
    return np.asarray((matrices @ vectors[..., None])[..., 0])
