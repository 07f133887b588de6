r"""The Kalman filter in the space of the states, for partly visible frames.

A frame tells about its state by the information :math:`J_t = C^\top R^{-1} C` and :math:`h_t =
C^\top R^{-1}(y_t - d)` over its visible channels, so that all matrices are q × q however many
channels there are. Covariances are computed once for each group of sequences with the same mask
(`Observations`). The means then follow a linear recurrence, one matrix–vector product a frame.

R. H. Shumway and D. S. Stoffer (1982), *An Approach to Time Series Smoothing and Forecasting Using
the EM Algorithm*, Journal of Time Series Analysis 3(4).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.state_space.model import StateSpaceParameters
from mocapbench.baselines.state_space.observations import Observations
from mocapbench.baselines.state_space.regression import transpose_each
from mocapbench.basics.arrays import Array

__all__ = ["Filtered", "filter_states", "recurrence"]


@dataclass(frozen=True, eq=False)
class Filtered:
    """The distributions of the states given the frames so far.

    Parameters
    ----------
    mean : ndarray of shape (K, N, q)
        Mean of each state given its frame and those before.
    covariance, predicted : ndarray of shape (U, N, q, q)
        Covariance by group of sequences, with and without the state's own frame.
    log_likelihood : ndarray of shape (K,)
        Log-density of the visible entries of each sequence.
    """

    mean: Array
    covariance: Array
    predicted: Array
    log_likelihood: Array


def filter_states(parameters: StateSpaceParameters, data: Observations) -> Filtered:
    """Return the filtered states of all sequences."""
    weights = data.visible / parameters.noise
    centred = data.visible * (data.values - parameters.offset)
    q = parameters.n_states
    information = (weights[data.leaders] @ parameters.squares).reshape(len(data.leaders), -1, q, q)
    score = (weights * centred) @ parameters.loadings
    predicted, covariance = _covariances(parameters, information)
    mean, before = _means(parameters, data, information, covariance, score)
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
    return Filtered(mean, covariance, predicted, np.where(data.frames, terms, 0.0).sum(axis=1))


def recurrence(gains: Array, shifts: Array) -> Array:
    """Return z_t = G_t z_{t−1} + b_t from z_{−1} = 0: gains (N, K, q, q), shifts (N, K, q)."""
    states = np.empty_like(shifts)
    state = np.zeros_like(shifts[0])
    for t, (gain, shift) in enumerate(zip(gains, shifts, strict=True)):
        state = (gain @ state[..., None])[..., 0] + shift
        states[t] = state
    return states


def _covariances(parameters: StateSpaceParameters, information: Array) -> tuple[Array, Array]:
    """Return the covariances (U, N, q, q) of the predicted and of the filtered states."""
    transition, noise = parameters.dynamics.coefficients, parameters.dynamics.covariance
    predicted, covariance = np.empty_like(information), np.empty_like(information)
    identity = np.eye(parameters.n_states)
    current = np.broadcast_to(parameters.start.covariance, information[:, 0].shape)
    for t in range(information.shape[1]):
        predicted[:, t] = current
        # (P⁻¹ + J)⁻¹ = (I + P J)⁻¹ P, which needs no inverse of P.
        updated = np.linalg.solve(identity + current @ information[:, t], current)
        covariance[:, t] = 0.5 * (updated + transpose_each(updated))
        current = transition @ covariance[:, t] @ transition.T + noise
    return predicted, covariance


def _means(
    parameters: StateSpaceParameters,
    data: Observations,
    information: Array,
    covariance: Array,
    score: Array,
) -> tuple[Array, Array]:
    """Return the means (K, N, q) of the filtered and of the predicted states.

    x_t = (I − P_t J_t) A x_{t−1} + P_t h_t.
    """
    transition = parameters.dynamics.coefficients
    kept = np.eye(parameters.n_states) - covariance @ information
    gains = (kept @ transition)[data.groups]
    shifts = (covariance[data.groups] @ score[..., None])[..., 0]
    first = parameters.start.coefficients[:, 0]
    shifts[:, 0] += (kept[:, 0] @ first)[data.groups]
    mean = recurrence(gains.swapaxes(0, 1), shifts.swapaxes(0, 1)).swapaxes(0, 1)
    before = np.empty_like(mean)
    before[:, 0] = first
    before[:, 1:] = mean[:, :-1] @ transition.T
    return mean, before
