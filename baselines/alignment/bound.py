"""The variational bound of HLM: all terms of eq. (3), with the penalties of eq. (6).

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

import numpy as np
from scipy.special import entr

from mocapbench.baselines.alignment.expectations import distance, log_likelihood, roughness
from mocapbench.baselines.alignment.model import CycleParameters, Hyperparameters, State
from mocapbench.baselines.alignment.sequences import Sequences
from mocapbench.basics.arrays import Array

__all__ = ["lower_bound", "sequence_bounds"]


def lower_bound(state: State, sequences: Sequences, hyper: Hyperparameters) -> float:
    """Return the lower bound on log p(X, θ); valid for any state, not only after an update."""
    shared = _cycles(state, hyper) + hyper.regularisation * _penalty(state.parameters)
    return float(sequence_bounds(state, sequences, hyper).sum() + shared)


def sequence_bounds(state: State, sequences: Sequences, hyper: Hyperparameters) -> Array:
    """Return the terms of each sequence, with its label, path and jumps: (K,)."""
    theta, labels, paths = state.parameters, state.labels, state.paths
    label = (labels * np.log(theta.weights) + entr(labels)).sum(axis=1)
    data = (labels * log_likelihood(state, sequences)).sum(axis=1)
    log_jumps = np.log(theta.jumps)
    jumps = ((paths.jumps + hyper.regularisation) * log_jumps).sum(axis=1)
    return np.asarray(label + data + jumps + paths.entropy - np.log(len(theta.parent)))


def _cycles(state: State, hyper: Hyperparameters) -> float:
    """Return the terms of the cycles: expected log-prior plus entropy of Q(Z)."""
    theta, cycles = state.parameters, state.cycles
    n_states, n_styles, n_channels = cycles.mean.shape
    normaliser = hyper.prior.log_normaliser(theta.smoothness, theta.closeness, n_states)
    energy = theta.smoothness * roughness(cycles, hyper.prior.reference(theta.parent))
    energy += theta.closeness * distance(cycles, theta.parent)
    log_determinants = cycles.log_determinant.sum()
    n_cycles = n_styles * n_channels
    entropy = 0.5 * (n_cycles * n_states * (1.0 + np.log(2.0 * np.pi)) - log_determinants)
    return float(n_cycles * normaliser - 0.5 * energy + entropy)


def _penalty(theta: CycleParameters) -> float:
    """Return the log-prior of parent and style weights, divided by η, without constants."""
    steps = np.roll(theta.parent, -1, axis=0) - theta.parent
    return float(np.log(theta.weights).sum() - (steps**2).sum())
