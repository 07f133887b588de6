r"""The M-step: the parameters that maximise the expected log-density plus the log-prior.

It is three regressions on the expected states (Ghahramani and Hinton 1996, eqs. 14–25, with a
mask and priors): of the first state on 1, of the next state on the state, and of each channel on
the state and 1 over the frames in which it is visible.

Z. Ghahramani and G. E. Hinton (1996), *Parameter Estimation for Linear Dynamical Systems*,
University of Toronto, CRG-TR-96-2.
"""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.state_space.model import Priors, StateSpaceParameters
from mocapbench.baselines.state_space.observations import Observations
from mocapbench.baselines.state_space.regression import Regression, Sums
from mocapbench.baselines.state_space.smoothing import Smoothed
from mocapbench.basics.arrays import Array

__all__ = ["maximise_parameters"]


def maximise_parameters(
    posterior: Smoothed, data: Observations, priors: Priors
) -> StateSpaceParameters:
    """Return the parameters with the highest expected posterior density."""
    second = posterior.covariance + _outer(posterior.mean, posterior.mean)
    second = np.where(data.frames[..., None, None], second, 0.0)
    mean = np.where(data.frames[..., None], posterior.mean, 0.0)
    return StateSpaceParameters(
        Regression.of(_start(mean, second), priors.start),
        Regression.of(_dynamics(posterior, second, data), priors.dynamics),
        Regression.of(_emission(mean, second, data), priors.emission),
    )


def _start(mean: Array, second: Array) -> Sums:
    n_sequences = np.full((1, 1), float(len(mean)))
    return Sums(second[:, 0].sum(axis=0), mean[:, 0].sum(axis=0)[:, None], n_sequences, n_sequences)


def _dynamics(posterior: Smoothed, second: Array, data: Observations) -> Sums:
    steps = data.frames[:, 1:]
    lagged = posterior.lagged + _outer(posterior.mean[:, 1:], posterior.mean[:, :-1])
    return Sums(
        second[:, 1:].sum(axis=(0, 1)),
        lagged[steps].sum(axis=0),
        second[:, :-1][steps].sum(axis=0),
        np.full((1, 1), float(steps.sum())),
    )


def _emission(mean: Array, second: Array, data: Observations) -> Sums:
    """Return the sums by channel, those of the regressors (x, 1) over its visible frames."""
    q, n_channels = mean.shape[2], data.values.shape[2]
    visible = data.visible.reshape(-1, n_channels)
    counts = visible.sum(axis=0)
    regressors = np.empty((n_channels, q + 1, q + 1))
    regressors[:, :q, :q] = (visible.T @ second.reshape(-1, q * q)).reshape(-1, q, q)
    regressors[:, :q, q] = regressors[:, q, :q] = visible.T @ mean.reshape(-1, q)
    regressors[:, q, q] = counts
    values = data.values.reshape(-1, n_channels)
    with_states = values.T @ mean.reshape(-1, q)
    responses = np.column_stack([with_states, values.sum(axis=0)])
    squares = (values**2).sum(axis=0)
    return Sums(squares[:, None, None], responses[:, None, :], regressors, counts[:, None, None])


def _outer(rows: Array, columns: Array) -> Array:
    """Return the outer products (…, q, q) of vectors (…, q)."""
    return np.asarray(rows[..., :, None] * columns[..., None, :])
