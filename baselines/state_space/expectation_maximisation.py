r"""Expectation–maximisation for one linear Gaussian state-space model, and where it starts.

The M-step is three regressions on the expected states (Ghahramani and Hinton 1996, eqs. 14–25, with
a mask and priors): of the first state on 1, of the next state on the state, and of each channel on
the state and 1 over the frames in which it is visible.

EM starts from principal components of short stretches of frames as states. Stretches of several
frames tell states apart that look alike in one frame, such as the same pose on the way up and down,
and let there be more states than channels. This is the idea of subspace identification.

Z. Ghahramani and G. E. Hinton (1996), *Parameter Estimation for Linear Dynamical Systems*,
University of Toronto, CRG-TR-96-2. P. Van Overschee and B. De Moor (1994), *N4SID: Subspace
Algorithms for the Identification of Combined Deterministic-Stochastic Systems*, Automatica 30(1).
"""

from __future__ import annotations

import warnings
from dataclasses import replace

import numpy as np

from mocapbench.baselines.common.ascent import Ascent, ascend
from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.common.signs import orient_vectors
from mocapbench.baselines.state_space.kalman import Smoothed, smooth_states
from mocapbench.baselines.state_space.linear_gaussian import (
    Priors,
    StateSpaceParameters,
    Sums,
    entry_moments,
    regress,
)
from mocapbench.basics.arrays import Array

__all__ = [
    "expectation_maximisation",
    "initial_states",
    "maximise_parameters",
    "show_noise",
    "start_parameters",
]

_REACH = 2
"""Frames before and after a frame in its stretch."""
_PRIOR_FRAMES, _PRIOR_NOISE = 1.0, 1e-2
"""One frame of noise: a channel of which little is visible keeps some."""
_NOISE_ITERATIONS = 5


def expectation_maximisation(
    parameters: StateSpaceParameters,
    data: Sequences,
    priors: Priors,
    *,
    max_iter: int,
    tol: float,
) -> Ascent[tuple[StateSpaceParameters, Smoothed]]:
    """Alternate M-step and E-step, ``max_iter`` times at most.

    The objective is the log-likelihood plus the log-prior; the state, parameters and the states
    that they make of the data. Stops when an iteration raises the objective by less than ``tol``
    per visible entry.
    """

    def infer(parameters: StateSpaceParameters) -> tuple[StateSpaceParameters, Smoothed]:
        return parameters, smooth_states(parameters, data)

    return ascend(
        infer(parameters),
        lambda now: infer(maximise_parameters(now[1], data, priors)),
        lambda now: float(now[1].log_likelihood.sum()) + now[0].log_prior(priors),
        max_iter=max_iter,
        threshold=tol * data.counts.sum(),
    )


def maximise_parameters(
    posterior: Smoothed, data: Sequences, priors: Priors
) -> StateSpaceParameters:
    """Return the parameters with the highest expected posterior density."""
    # ⟨x xᵀ⟩ = P + x̂ x̂ᵀ, and nothing at the padding.
    second = posterior.covariance + _outer(posterior.mean, posterior.mean)
    second = np.where(data.frames[..., None, None], second, 0.0)
    mean = np.where(data.frames[..., None], posterior.mean, 0.0)
    start, dynamics, emission = priors
    return StateSpaceParameters(
        *regress(_start_sums(mean, second), start),
        *regress(_dynamics_sums(posterior, second, data), dynamics),
        *regress(_emission_sums(mean, second, data), emission),
    )


def show_noise(parameters: StateSpaceParameters, data: Sequences) -> StateSpaceParameters:
    """Return the parameters with the noise of each channel as its visible entries show it.

    These are a few iterations of EM in which all else is kept.
    """
    for _ in range(_NOISE_ITERATIONS):
        states = smooth_states(parameters, data)
        mean, variance = entry_moments(parameters, states.mean, states.covariance)
        # ⟨(y − C x − d)²⟩: the squared error, and the variance that states leave.
        squares = (data.values - mean) ** 2 + variance - parameters.noise
        sums = np.where(data.visible, squares, 0.0).sum(axis=(0, 1))
        counts = data.visible.sum(axis=(0, 1)) + _PRIOR_FRAMES
        noise = (sums + _PRIOR_FRAMES * _PRIOR_NOISE) / counts
        parameters = replace(parameters, emission_covariance=noise[:, None, None])
    return parameters


def initial_states(data: Sequences, n_states: int) -> Array:
    """Return the components of all sequences, 0 at the padding: (K, N, q).

    Where the data has fewer than ``n_states`` dimensions, q is their number, at least 1, and a
    warning is issued.
    """
    states = _first_components(
        np.concatenate([_stack_stretches(y) for y in data.interpolate_hidden()]), n_states
    )
    padded = np.zeros((*data.frames.shape, states.shape[1]))
    padded[data.frames] = states
    return padded


def start_parameters(states: Array, data: Sequences, priors: Priors) -> StateSpaceParameters:
    """Return the parameters that are most probable if ``states`` (K, N, q) are the states."""
    certain = np.zeros((*states.shape, states.shape[2]))
    known = Smoothed(states, certain, certain[:, 1:], np.zeros(len(states)))
    return maximise_parameters(known, data, priors)


def _start_sums(mean: Array, second: Array) -> Sums:
    n_sequences = np.full((1, 1), float(len(mean)))
    return second[:, 0].sum(axis=0), mean[:, 0].sum(axis=0)[:, None], n_sequences, n_sequences


def _dynamics_sums(posterior: Smoothed, second: Array, data: Sequences) -> Sums:
    steps = data.frames[:, 1:]
    # ⟨x_{t+1} x_tᵀ⟩ of the steps inside sequences.
    lagged = posterior.lagged + _outer(posterior.mean[:, 1:], posterior.mean[:, :-1])
    return (
        second[:, 1:].sum(axis=(0, 1)),
        lagged[steps].sum(axis=0),
        second[:, :-1][steps].sum(axis=0),
        np.full((1, 1), float(steps.sum())),
    )


def _emission_sums(mean: Array, second: Array, data: Sequences) -> Sums:
    """Return the sums by channel, those of the regressors (x, 1) over its visible frames."""
    q, n_channels = mean.shape[2], data.values.shape[2]
    visible = data.visible.reshape(-1, n_channels)
    counts = visible.sum(axis=0)
    # Σ over visible frames of ⟨(x, 1)(x, 1)ᵀ⟩ and y (x, 1)ᵀ.
    regressors = np.empty((n_channels, q + 1, q + 1))
    regressors[:, :q, :q] = (visible.T @ second.reshape(-1, q * q)).reshape(-1, q, q)
    regressors[:, :q, q] = regressors[:, q, :q] = visible.T @ mean.reshape(-1, q)
    regressors[:, q, q] = counts
    values = data.values.reshape(-1, n_channels)
    with_states = values.T @ mean.reshape(-1, q)
    responses = np.column_stack([with_states, values.sum(axis=0)])
    squares = (values**2).sum(axis=0)
    return squares[:, None, None], responses[:, None, :], regressors, counts[:, None, None]


def _outer(rows: Array, columns: Array) -> Array:
    """Return the outer products (…, q, q) of vectors (…, q)."""
    return np.asarray(rows[..., :, None] * columns[..., None, :])


def _stack_stretches(frames: Array) -> Array:
    """Return each frame (N, D) with those beside it: (N, (2 reach + 1) D); the ends repeat."""
    n = len(frames)
    near = np.arange(n)[:, None] + np.arange(-_REACH, _REACH + 1)
    return np.asarray(frames[np.clip(near, 0, n - 1)].reshape(n, -1))


def _first_components(rows: Array, n_states: int) -> Array:
    """Return the first principal components of ``rows`` (n, m), scaled to variance 1: (n, q)."""
    centred = rows - rows.mean(axis=0)
    # Principal axes, the largest variance last; scores over their standard deviations are white.
    variances, axes = np.linalg.eigh(centred.T @ centred / len(rows))
    rank = int((variances > variances[-1] * max(rows.shape) * np.finfo(float).eps).sum())
    if rank < n_states:
        warnings.warn(
            f"expected training data of at least n_states={n_states} dimensions, got {rank}: the "
            f"model has {max(rank, 1)} states",
            stacklevel=5,
        )
    if rank == 0:
        return np.zeros((len(rows), 1))
    kept = slice(-1, -min(rank, n_states) - 1, -1)
    axes = orient_vectors(axes)  # the signs of states decide what is drawn
    return np.asarray(centred @ axes[:, kept] / np.sqrt(variances[kept]))
