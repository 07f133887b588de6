"""The variational bound of HLM, eq. (3) with the penalties of eq. (6), every term of it."""

from __future__ import annotations

import numpy as np
from scipy.special import entr

from mocapbench.baselines.alignment.expectations import distance, log_likelihood, roughness
from mocapbench.baselines.alignment.model import Hyperparameters, Parameters, State
from mocapbench.baselines.alignment.sequences import Sequences

__all__ = ["bound"]


def bound(state: State, sequences: Sequences, hyper: Hyperparameters) -> float:
    """Return the bound on log p(X, θ); it holds for any state, not only after an update."""
    return (
        _data(state, sequences)
        + _labels(state)
        + _paths(state)
        + _cycles(state, hyper)
        + hyper.regularisation * _penalty(state.parameters)
    )


def _data(state: State, sequences: Sequences) -> float:
    return float((state.labels * log_likelihood(state, sequences)).sum())


def _labels(state: State) -> float:
    labels = state.labels
    return float((labels * np.log(state.parameters.weights) + entr(labels)).sum())


def _paths(state: State) -> float:
    paths = state.paths
    n_sequences, _, n_states = paths.occupancy.shape
    transitions = (paths.jumps * np.log(state.parameters.jumps)).sum()
    return float(transitions + paths.entropy.sum() - n_sequences * np.log(n_states))


def _cycles(state: State, hyper: Hyperparameters) -> float:
    theta, cycles = state.parameters, state.cycles
    n_states, n_styles, n_channels = cycles.mean.shape
    normaliser = hyper.prior.log_normaliser(theta.smoothness, theta.closeness, n_states)
    energy = theta.smoothness * roughness(cycles)
    energy += theta.closeness * distance(cycles, theta.parent)
    log_determinants = cycles.log_determinant.sum()
    n_cycles = n_styles * n_channels
    entropy = 0.5 * (n_cycles * n_states * (1.0 + np.log(2.0 * np.pi)) - log_determinants)
    return float(n_cycles * normaliser - 0.5 * energy + entropy)


def _penalty(theta: Parameters) -> float:
    """Logarithm of the prior of θ per unit of η: smooth parent, weights and jumps off zero."""
    steps = np.roll(theta.parent, -1, axis=0) - theta.parent
    return float(-(steps**2).sum() + np.log(theta.weights).sum() + np.log(theta.jumps).sum())
