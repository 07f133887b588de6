"""The start of EM: principal components of short stretches of frames as states.

Stretches of several frames tell states apart that look alike in one frame, such as the same pose
on the way up and down, and let there be more states than channels. This is the idea of subspace
identification.

P. Van Overschee and B. De Moor (1994), *N4SID: Subspace Algorithms for the Identification of
Combined Deterministic-Stochastic Systems*, Automatica 30(1).
"""

from __future__ import annotations

import warnings

import numpy as np

from mocapbench.baselines.common.signs import orient_vectors
from mocapbench.baselines.state_space.maximisation import maximise_parameters
from mocapbench.baselines.state_space.model import Priors, StateSpaceParameters
from mocapbench.baselines.state_space.observations import Observations
from mocapbench.baselines.state_space.smoothing import Smoothed
from mocapbench.basics.arrays import Array

__all__ = ["initial_states", "start"]

_REACH = 2
"""Frames before and after a frame in its stretch."""


def initial_states(data: Observations, n_states: int) -> Array:
    """Return the components of all sequences, 0 at the padding: (K, N, q).

    Where the data has fewer than ``n_states`` dimensions, q is their number, at least 1, and a
    warning is issued.
    """
    states = _components(
        np.concatenate([_stretches(y) for y in data.interpolate_hidden()]), n_states
    )
    padded = np.zeros((*data.frames.shape, states.shape[1]))
    padded[data.frames] = states
    return padded


def start(states: Array, data: Observations, priors: Priors) -> StateSpaceParameters:
    """Return the parameters that are most probable if ``states`` (K, N, q) are the states."""
    certain = np.zeros((*states.shape, states.shape[2]))
    known = Smoothed(states, certain, certain[:, 1:], np.zeros(len(states)))
    return maximise_parameters(known, data, priors)


def _stretches(frames: Array) -> Array:
    """Return each frame (N, D) with those beside it: (N, (2 reach + 1) D); the ends repeat."""
    n = len(frames)
    near = np.arange(n)[:, None] + np.arange(-_REACH, _REACH + 1)
    return np.asarray(frames[np.clip(near, 0, n - 1)].reshape(n, -1))


def _components(rows: Array, n_states: int) -> Array:
    """Return the first principal components of ``rows`` (n, m), scaled to variance 1: (n, q)."""
    centred = rows - rows.mean(axis=0)
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
