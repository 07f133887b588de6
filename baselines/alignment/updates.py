"""The updates of HLM §3, one function each. No update lowers the bound.

Equation numbers are those of HLM. Where a printed formula is wrong, the docstring gives the
corrected one.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from scipy.linalg import solve_circulant

from mocapbench.baselines.alignment import ring
from mocapbench.baselines.alignment.chain import forward_backward
from mocapbench.baselines.alignment.expectations import (
    distance,
    emission,
    log_likelihood,
    residuals,
    roughness,
)
from mocapbench.baselines.alignment.model import CycleParameters, Evidence, Hyperparameters, State
from mocapbench.baselines.alignment.sequences import Sequences
from mocapbench.basics.arrays import Array

__all__ = [
    "update_closeness",
    "update_cycles",
    "update_jumps",
    "update_labels",
    "update_parent",
    "update_paths",
    "update_precisions",
    "update_smoothness",
    "update_weights",
]


def update_paths(state: State, sequences: Sequences, _: Hyperparameters) -> State:
    """Update Q(π), eq. (7), by forward–backward on the expected log-likelihoods, eq. (10)."""
    parameters = state.parameters
    expected = emission(sequences, state.cycles, parameters.precisions, state.labels)
    paths = forward_backward(expected, parameters.jumps, sequences.frames)
    return replace(state, paths=paths, evidence=Evidence.of(sequences, paths))


def update_labels(state: State, sequences: Sequences, _: Hyperparameters) -> State:
    """Update Q(l), eq. (11), over visible entries."""
    score = np.log(state.parameters.weights) + log_likelihood(state, sequences)
    score -= score.max(axis=1, keepdims=True)
    labels = np.exp(score)
    return replace(state, labels=labels / labels.sum(axis=1, keepdims=True))


def update_cycles(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Update Q(Z), eq. (9), corrected.

    The precision S of a channel has the diagonal 2λ_s + λ_z̄ + λ_f n_m, with n_m the expected number
    of visible entries of state m, and the mean is S⁻¹ (λ_z̄ z̄ + λ_f Σ γ x). HLM divides the sum by
    n_m and omits S⁻¹.
    """
    theta = state.parameters
    counts, sums = state.evidence.by_style(state.labels)
    ground = theta.closeness + theta.precisions * counts
    right = _pull(theta.parent, theta, hyper)[:, None] + theta.precisions * sums
    return replace(state, cycles=ring.solve(theta.smoothness, ground, right))


def update_parent(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Update z̄, eq. (17) with the missing bracket.

    It solves (Cλ_z̄ + 4η) z̄_m − 2η (z̄_{m−1} + z̄_{m+1}) = λ_z̄ Σ_c ⟨z_m^c⟩. For the centred prior the
    precision matrix of a cycle takes the place of λ_z̄.
    """
    theta, (n_states, n_styles, _channels) = state.parameters, state.cycles.mean.shape
    impulse = np.eye(n_states)[0]
    column = n_styles * _pull(impulse, theta, hyper)
    column += 2.0 * hyper.regularisation * _curvature(impulse)
    right = _pull(state.cycles.mean.sum(axis=1), theta, hyper)
    return _learnt(state, parent=solve_circulant(column, right))


def update_smoothness(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Update λ_s: eq. (13) or its equivalent for the chosen prior."""
    n_states, *batch = state.cycles.mean.shape
    reference = hyper.prior.reference(state.parameters.parent)
    mean = roughness(state.cycles, reference) / np.prod(batch)
    best = hyper.prior.smoothness(state.parameters.closeness, n_states, mean)
    return _learnt(state, smoothness=best)


def update_closeness(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Update λ_z̄: eq. (12) or its equivalent for the chosen prior."""
    n_states, *batch = state.cycles.mean.shape
    mean = distance(state.cycles, state.parameters.parent) / np.prod(batch)
    best = hyper.prior.closeness(state.parameters.smoothness, n_states, mean)
    return _learnt(state, closeness=best)


def update_precisions(state: State, sequences: Sequences, hyper: Hyperparameters) -> State:
    """Update λ_f^c, eq. (14), over visible entries; a style without any keeps its precision."""
    counts = state.labels.T @ sequences.counts
    squares = np.einsum("kc,kcf->cf", state.labels, residuals(state, sequences))
    best = counts / np.maximum(squares, counts / hyper.max_precision + np.finfo(float).tiny)
    return _learnt(state, precisions=np.where(best > 0, best, state.parameters.precisions))


def update_weights(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Update τ, eq. (15)."""
    weights = hyper.regularisation + state.labels.sum(axis=0)
    return _learnt(state, weights=weights / weights.sum())


def update_jumps(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Update d, eq. (16), where ξ is the joint posterior of two consecutive states."""
    jumps = hyper.regularisation + state.paths.jumps
    return _learnt(state, jumps=jumps / jumps.sum(axis=1, keepdims=True))


def _pull(curves: Array, theta: CycleParameters, hyper: Hyperparameters) -> Array:
    """Return a parent's contribution to precision times mean of its cycles: λ_z̄ z̄ in HLM."""
    shape = theta.smoothness * _curvature(hyper.prior.reference(curves))
    return theta.closeness * curves + shape


def _curvature(curves: Array) -> Array:
    """Return the Laplacian of the ring times curves (M, …)."""
    return 2.0 * curves - np.roll(curves, 1, axis=0) - np.roll(curves, -1, axis=0)


def _learnt(state: State, **parameters: Any) -> State:
    """Return the state with some parameters of θ replaced."""
    return replace(state, parameters=replace(state.parameters, **parameters))
